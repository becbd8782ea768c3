#include <sys/prctl.h>

#include <algorithm>
#include <chrono>

#include "host/drives/bus_simulator/bus_hub.hpp"

namespace liana::bus_simulator {
namespace {

constexpr std::uint64_t kLookUpNs = 100'000'000;  // how often a stop is noticed at least

// Plays the wires up to `until_ns`.
void run_wires(BusHub& hub, std::uint64_t until_ns) {
  for (;;) {
    hub.sim().arbitrate(hub.now_ns);
    const std::uint64_t end_ns = hub.sim().next_end_ns();
    if (end_ns > until_ns) break;
    hub.now_ns = end_ns;
    hub.sim().finish(end_ns);
  }
  hub.now_ns = until_ns;
}

void take_frames(BusHub& hub) {
  for (std::size_t i = 0; i < hub.participants().size(); ++i) {
    while (!hub.ended() && hub.read_yield(i, false)) hub.queue_yield(i);
  }
}

void hand_over(BusHub& hub) {
  for (std::size_t i = 0; i < hub.participants().size() && !hub.ended(); ++i) {
    if (hub.participants()[i].frames() > 0) hub.wake(i, 0, false);
  }
}

}  // namespace

void run_real(BusHub& hub) {
  prctl(PR_SET_TIMERSLACK, 1UL);  // a frame is shorter than the usual 50 us slack
  const auto start = std::chrono::steady_clock::now();
  const auto now_ns = [start] {
    return static_cast<std::uint64_t>(std::chrono::nanoseconds(std::chrono::steady_clock::now() - start).count());
  };
  for (std::size_t i = 0; i < hub.participants().size(); ++i) hub.wake(i, wire::kWakeSlotStart, true);
  while (!hub.ended()) {
    run_wires(hub, now_ns());
    take_frames(hub);
    hub.sim().arbitrate(hub.now_ns);
    hand_over(hub);
    const std::uint64_t end_ns = hub.sim().next_end_ns();
    const std::uint64_t present_ns = now_ns();
    const std::uint64_t wait_ns = end_ns > present_ns ? end_ns - present_ns : 0;
    if (!hub.ended()) hub.wait_readable(std::min(wait_ns, kLookUpNs));
  }
}

}  // namespace liana::bus_simulator
