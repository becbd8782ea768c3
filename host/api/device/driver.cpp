#include "host/api/device/driver.hpp"

#include <algorithm>

#include "host/base/net/connect.hpp"

namespace liana::device {

std::string devices_path(const std::string& api_path) { return api_path + ".devices"; }

Driver Driver::connect(const std::string& path, const Capability& capability, std::int64_t now_us, double timeout_s) {
  check(capability);
  Driver driver(api::connect_to("--devices", path, timeout_s), capability.watchdog_s);
  if (api::send_packet(driver.fd_.get(), bytes_of(hello_of(capability, now_us))) != api::SocketResult::kDone)
    driver.close("lianad does not take devices now; try again");
  return driver;
}

bool Driver::send(std::span<const Sample> samples) {
  if (!is_open()) return samples.empty();
  std::vector<liana_sample> packets;
  packets.reserve(samples.size());
  for (const Sample& sample : samples) packets.push_back(packet_of(sample, ++sequence_, echo_));
  std::vector<std::string_view> bytes;
  bytes.reserve(packets.size());
  for (const liana_sample& packet : packets) bytes.push_back(bytes_of(packet));
  std::span<const std::string_view> left(bytes);
  api::send_packets(fd_.get(), left);
  lost_ += left.size();
  return left.empty();  // that lianad has left is found by reading: why it refused is still there
}

bool Driver::receive(std::optional<std::int64_t> now_us) {
  bool has_news = false;
  std::string_view packet;
  while (is_open()) {
    const api::SocketResult result = reader_.next(fd_.get(), packet);
    if (result == api::SocketResult::kWouldBlock) break;
    if (result == api::SocketResult::kClosed) {
      close("lianad is gone: the socket of devices was closed by the other end");
    } else {
      has_news = take(packet, now_us) || has_news;
    }
  }
  return has_news;
}

bool Driver::take(std::string_view bytes, std::optional<std::int64_t> now_us) {
  const Incoming in = look_at(bytes);
  if (!in.problem.empty()) {
    close("lianad speaks another protocol: " + in.problem);
    return false;
  }
  switch (in.header.packet) {
    case LIANA_WELCOME:
      welcome_ = read<liana_welcome>(bytes);
      welcome_us_ = now_us;
      return false;
    case LIANA_REFUSED: {
      const auto refused = read<liana_refused>(bytes);
      close("refused: " + text_of(refused.text, sizeof refused.text));
      return false;
    }
    case LIANA_STATE:
      state_ = read<liana_state>(bytes);
      if (now_us) echo_ = {in.header.sequence, *now_us};
      return true;
    default:
      return false;  // nothing that comes down
  }
}

void Driver::leave() {
  if (!is_open()) return;
  api::send_packet(fd_.get(), bytes_of(make<liana_bye>(LIANA_BYE)));
  close("left");
}

void Driver::close(const std::string& why) {
  problem_ = why;
  fd_ = api::UniqueFd();
}

const liana_state* Driver::state(std::int64_t now_us) const {
  if (!state_ || echo_.sequence == 0 || !is_open()) return nullptr;
  const double most_s = std::min(watchdog_s_, state_->watchdog_s);
  return static_cast<double>(now_us - echo_.came_us) * 1e-6 <= most_s ? &*state_ : nullptr;
}

std::optional<std::int64_t> Driver::arm_ahead_us() const {
  if (!welcome_us_) return std::nullopt;
  return welcome_->arm_time_us - *welcome_us_;
}

}  // namespace liana::device
