#include "host/apps/ground/gaps.hpp"

#include <algorithm>
#include <utility>

namespace liana::ground {

std::uint64_t time_of(const Telemetry& telemetry) {
  if (telemetry.primary.has_secondary) return telemetry.time_us;
  constexpr std::size_t kPlace = 1;  // behind the exponent
  if (telemetry.data.size() < kPlace + kTimeBytes) return 0;
  return read_time(std::string_view(telemetry.data).substr(kPlace));
}

// The times of packets never go back, so an earlier one was overtaken or comes again.
void Gaps::take(const Telemetry& packet, double now_s) {
  const auto [apid, count] = std::pair{packet.primary.apid, packet.primary.count};
  const std::uint64_t time_us = time_of(packet);
  const auto newest = newest_.find(apid);
  if (newest != newest_.end()) {
    if (fill(apid, count, time_us) || time_us < newest->second.time_us) return;
    if (is_of_a_new_life(packet, newest->second)) begin_life(apid, {newest->second.time_us, time_us}, now_s);
  }
  if (packet.primary.has_secondary) newest_message_[{packet.service, packet.subtype}] = {count, packet.message_count};
  const auto [place, is_first] = newest_.try_emplace(apid, Newest{count, time_us});
  if (is_first) return;
  const Newest before = std::exchange(place->second, {count, time_us});
  Gap gap{apid, {}, {before.time_us, time_us}, now_s + kGrace_s};
  for (unsigned each = before.count + 1u; each % kCountModulus != count; ++each)
    gap.missing.insert(static_cast<std::uint16_t>(each % kCountModulus));
  if (before.count == count || gap.missing.empty()) return;
  found_ += gap.missing.size();
  add(std::move(gap));
}

// The oldest makes room: it has been asked for most often, or by a store of an earlier life.
void Gaps::add(Gap gap) {
  if (gaps_.size() == kMaxGaps) {
    lost_ += gaps_.front().missing.size();
    gaps_.pop_front();
  }
  gaps_.push_back(std::move(gap));
}

void Gaps::take_together(std::vector<Telemetry> packets, double now_s) {
  std::stable_sort(packets.begin(), packets.end(),
                   [this](const Telemetry& a, const Telemetry& b) { return ahead(a) < ahead(b); });
  for (const Telemetry& each : packets) take(each, now_s);
}

// By how many packets of its APID it is beyond the newest.
unsigned Gaps::ahead(const Telemetry& packet) const {
  const auto newest = newest_.find(packet.primary.apid);
  const unsigned from = newest == newest_.end() ? 0u : newest->second.count;
  return (packet.primary.count + kCountModulus - from) % kCountModulus;
}

// Of one life no service counts further than all of them together, neither since its last message nor from 0 on.
bool Gaps::is_of_a_new_life(const Telemetry& packet, const Newest& before) const {
  if (!packet.primary.has_secondary || packet.primary.count == before.count) return false;
  const auto message = newest_message_.find({packet.service, packet.subtype});
  if (message == newest_message_.end()) return false;
  const auto messages = static_cast<std::uint16_t>(packet.message_count - message->second.message_count);
  const unsigned packets = (packet.primary.count + kCountModulus - message->second.count) % kCountModulus;
  return messages > packets && packet.message_count <= packet.primary.count;
}

// Between the end of one life and the beginning of the next nothing counts as missing, whichever APID showed it first.
// It is asked for once: an outage of more packets than a count knows can look like this.
void Gaps::begin_life(std::uint16_t apid, const Span& between, double now_s) {
  std::erase_if(gaps_, [&](const Gap& each) {
    const bool is_between = each.span.from_us < between.to_us && each.span.to_us > between.from_us;
    if (is_between) found_ -= each.missing.size();
    return is_between;
  });
  std::erase_if(newest_, [&](const auto& each) { return each.second.time_us < between.to_us; });
  newest_message_.clear();
  add({apid, {}, between, now_s + kGrace_s, kMaxTries - 1});
}

bool Gaps::fill(std::uint16_t apid, std::uint16_t count, std::uint64_t time_us) {
  const auto gap = std::find_if(gaps_.begin(), gaps_.end(), [&](const Gap& each) {
    return each.apid == apid && time_us >= each.span.from_us && time_us <= each.span.to_us &&
           each.missing.contains(count);
  });
  if (gap == gaps_.end()) return false;
  gap->missing.erase(count);
  ++filled_;
  if (gap->missing.empty()) gaps_.erase(gap);
  return true;
}

std::optional<Gaps::Span> Gaps::ask(double now_s) {
  std::erase_if(gaps_, [&](const Gap& each) {
    if (each.tries < kMaxTries || now_s < each.next_s) return false;
    lost_ += each.missing.size();
    return true;
  });
  const auto due = std::find_if(gaps_.begin(), gaps_.end(), [&](const Gap& each) { return now_s >= each.next_s; });
  if (due == gaps_.end()) return std::nullopt;
  // One question for all gaps that overlap it: an outage cuts every APID.
  const Span span = due->span;
  for (Gap& each : gaps_) {
    if (each.span.from_us < span.from_us || each.span.to_us > span.to_us) continue;
    each.next_s = now_s + kAgain_s;
    ++each.tries;
  }
  return span;
}

}  // namespace liana::ground
