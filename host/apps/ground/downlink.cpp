#include "host/apps/ground/downlink.hpp"

#include <algorithm>

namespace liana::ground {

void Downlink::report(std::uint8_t service, std::uint8_t subtype, std::uint16_t destination, std::uint64_t time_us,
                      std::string data) {
  Telemetry out;
  out.primary.apid = kArmApid;
  out.primary.has_secondary = true;
  out.service = service;
  out.subtype = subtype;
  out.message_count = message_counts_[{service, subtype}]++;
  out.destination = destination;
  out.time_us = time_us;
  out.data = std::move(data);
  send(std::move(out));
}

void Downlink::time_packet(std::uint64_t time_us, std::string data) {
  Telemetry out;
  out.primary.apid = kTimeApid;
  out.time_us = time_us;
  out.data = std::move(data);
  send(std::move(out));
}

void Downlink::send(Telemetry telemetry) {
  newest_us_ = telemetry.time_us = std::max(newest_us_, telemetry.time_us);
  std::uint16_t& count = counts_[telemetry.primary.apid];
  telemetry.primary.count = count;
  count = static_cast<std::uint16_t>((count + 1) % kCountModulus);
  std::string packet = telemetry_bytes(telemetry);
  send_(packet);
  ++sent_;
  kept_bytes_ += packet.size();
  store_.push_back({newest_us_, std::move(packet)});
  while (kept_bytes_ > store_bytes_ && !store_.empty()) {
    kept_bytes_ -= store_.front().packet.size();
    store_.pop_front();
    ++dropped_;
    if (left_ > 0 && next_ == 0) --left_;
    if (left_ > 0 && next_ > 0) --next_;
  }
}

bool Downlink::begin_resend(std::uint64_t from_us, std::uint64_t to_us) {
  if (is_resending()) return false;
  const auto first = std::lower_bound(store_.begin(), store_.end(), from_us,
                                      [](const Kept& kept, std::uint64_t time_us) { return kept.time_us < time_us; });
  const auto last = std::upper_bound(first, store_.end(), to_us,
                                     [](std::uint64_t time_us, const Kept& kept) { return time_us < kept.time_us; });
  next_ = static_cast<std::size_t>(first - store_.begin());
  left_ = static_cast<std::size_t>(last - first);
  return true;
}

void Downlink::go_on_resending(std::size_t packets) {
  for (; packets > 0 && left_ > 0; --packets, --left_) send_(store_[next_++].packet);
}

}  // namespace liana::ground
