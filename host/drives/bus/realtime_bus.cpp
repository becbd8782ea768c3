#include "host/drives/bus/realtime_bus.hpp"

#include <ctime>

namespace liana::bus {

timing::TickStart RealtimeBus::begin_tick(std::uint64_t tick) noexcept {
  timing::TickStart start = clock_.wait(tick);
  book_.begin_tick();
  start.ended = ended();
  return start;
}

void RealtimeBus::wait_feedback(int expected_tpdos) noexcept {
  flush();
  drain();
  while (book_.feedback() < expected_tpdos && !ended()) {
    const std::uint64_t left_ns = clock_.left_to_half_ns();
    if (left_ns == 0) return;
    const timespec timeout{static_cast<time_t>(left_ns / 1'000'000'000), static_cast<long>(left_ns % 1'000'000'000)};
    if (ppoll(watched_.data(), watched_count_, &timeout, nullptr) <= 0) continue;
    drain();
    if (any_failed()) return;  // a dead socket reports itself without end
  }
}

bool RealtimeBus::any_failed() const noexcept {
  for (nfds_t i = 0; i < watched_count_; ++i) {
    if ((watched_[i].revents & (POLLERR | POLLHUP)) != 0) return true;
  }
  return false;
}

void RealtimeBus::watch(int descriptor) noexcept { watched_[watched_count_++] = {descriptor, POLLIN, 0}; }

}  // namespace liana::bus
