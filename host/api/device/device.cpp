#include "host/api/device/device.hpp"

#include <utility>

namespace liana::device {

std::optional<Capability> Device::hear(std::int64_t now_us) {
  std::string_view packet;
  while (end_.empty()) {
    const api::SocketResult result = reader_.next(fd_.get(), packet);
    if (result == api::SocketResult::kWouldBlock) break;
    if (result == api::SocketResult::kClosed) {
      end_ = "connection closed";
    } else if (++packets_ > kMaxPacketsPerInterval) {
      refuse(std::to_string(kMaxPacketsPerInterval) +
             " packets in a command interval are allowed: send at the rate of hello");
    } else if (auto hello = take(packet, now_us)) {
      return hello;
    }
  }
  return std::nullopt;
}

std::optional<Capability> Device::take(std::string_view bytes, std::int64_t now_us) {
  const Incoming in = look_at(bytes);
  if (!in.problem.empty()) {
    refuse(in.problem);
  } else if (in.header.packet == LIANA_HELLO && !known_) {
    const auto hello = read<liana_hello>(bytes);
    hello_us_ = hello.t_us;
    return capability_of(hello);
  } else if (in.header.packet == LIANA_SAMPLE && known_) {
    take_sample(read<liana_sample>(bytes), now_us);
  } else if (in.header.packet == LIANA_BYE) {
    end_ = "said bye";
  } else {
    refuse("header.packet = " + std::to_string(in.header.packet) + ": allowed first a hello, then samples and bye");
  }
  return std::nullopt;
}

void Device::welcome(const Capability& capability, const liana_welcome& welcome) {
  known_ = capability;
  liana_welcome out = welcome;
  out.answers_us = hello_us_;
  api::send_packet(fd_.get(), bytes_of(out));
}

void Device::refuse(const std::string& why) {
  api::send_packet(fd_.get(), bytes_of(refused_of(why)));
  end_ = why;
  was_refused_ = true;
}

// The device's own clock only grows, and no faster than time passes; who sets it says hello again.
const char* Device::clock_problem(const liana_sample& packet, std::int64_t now_us) const {
  const std::optional<Sample>& before = newest_[packet.hand];
  if (!before) return nullptr;
  if (packet.t_us <= before->t_us) return "t_us: allowed later than that of the sample before";
  const std::int64_t passed_us = now_us - heard_us_[packet.hand];
  if (packet.t_us - before->t_us > passed_us + kClockJump_us)
    return "t_us: allowed at most 0.5 s further on than time has gone";
  return nullptr;
}

void Device::take_sample(const liana_sample& packet, std::int64_t now_us) {
  const char* problem = problem_of(packet, known_->hands);
  if (problem == nullptr) problem = clock_problem(packet, now_us);
  if (problem != nullptr) {
    ++refused_samples_;
    if (++refused_in_row_ >= kMaxRefused)
      refuse(std::to_string(kMaxRefused) + " samples in a row were refused, the last for " + problem);
    return;
  }
  refused_in_row_ = 0;
  samples_.push_back(sample_of(packet));
  newest_[packet.hand] = samples_.back();
  heard_us_[packet.hand] = now_us;
  rate_[packet.hand].add(packet.t_us);
  hear_echo(packet, now_us);
}

// Only the first sample after a state tells how long it took: the others have waited.
void Device::hear_echo(const liana_sample& packet, std::int64_t now_us) {
  const std::uint32_t echo = packet.echo_sequence;
  if (echo <= echoed_ || echo > sequence_) return;
  echoed_ = echo;
  if (sequence_ - echo < kRemembered) clock_.add(sent_us_[echo % kRemembered], packet.echo_us, packet.t_us, now_us);
}

void Device::tell(liana_state state, std::int64_t now_us) {
  state.header.sequence = ++sequence_;
  sent_us_[sequence_ % kRemembered] = now_us;
  if (api::send_packet(fd_.get(), bytes_of(state)) == api::SocketResult::kWouldBlock) ++lost_states_;
}

void Device::finish_interval(double interval_s) {
  packets_ = 0;
  for (SampleRate& rate : rate_) rate.finish_interval(interval_s);
}

}  // namespace liana::device
