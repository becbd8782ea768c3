#include "host/base/clock/tick_clock.hpp"

#include <cerrno>
#include <ctime>

namespace liana::timing {
namespace {

constexpr std::uint64_t kNanosecondsPerSecond = 1'000'000'000;

std::uint64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::uint64_t>(now.tv_sec) * kNanosecondsPerSecond + static_cast<std::uint64_t>(now.tv_nsec);
}

void sleep_until_ns(std::uint64_t deadline_ns) noexcept {
  const timespec deadline{static_cast<time_t>(deadline_ns / kNanosecondsPerSecond),
                          static_cast<long>(deadline_ns % kNanosecondsPerSecond)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &deadline, nullptr) == EINTR) {
  }
}

}  // namespace

TickStart TickClock::wait(std::uint64_t tick) noexcept {
  const std::uint64_t now_ns = monotonic_ns();
  if (epoch_ns_ == 0) epoch_ns_ = now_ns + period_ns_ - tick * period_ns_;
  TickStart start{tick, 0, 0, false};
  deadline_ns_ = epoch_ns_ + tick * period_ns_;
  if (deadline_ns_ < now_ns) {
    start.lost_ticks = static_cast<std::uint32_t>((now_ns - deadline_ns_) / period_ns_ + 1);
    start.tick += start.lost_ticks;
    deadline_ns_ += start.lost_ticks * period_ns_;
  }
  sleep_until_ns(deadline_ns_);
  start.lateness_us = static_cast<std::uint32_t>((monotonic_ns() - deadline_ns_) / 1000);
  return start;
}

std::uint64_t TickClock::left_to_half_ns() const noexcept {
  const std::uint64_t now_ns = monotonic_ns();
  const std::uint64_t half_ns = deadline_ns_ + period_ns_ / 2;
  return half_ns > now_ns ? half_ns - now_ns : 0;
}

std::uint64_t TickClock::now_us() const noexcept {
  const std::uint64_t now_ns = monotonic_ns();
  return epoch_ns_ != 0 && now_ns > epoch_ns_ ? (now_ns - epoch_ns_) / 1000 : 0;
}

}  // namespace liana::timing
