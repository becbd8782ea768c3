// When one of lianad's threads fails, the other one ends the motion: nothing that goes wrong leaves the arm moving with
// nobody in charge.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

#include "host/control/realtime/link.hpp"

namespace liana::realtime {

// How a thread ended. `problem` is written before `over`: read it only when `over` is true.
struct ThreadResult {
  std::atomic<bool> over{false};
  std::string problem;  // empty: it ended as it should
};

// Runs `body`; whatever it throws becomes end.problem.
void run_guarded(const std::function<void()>& body, ThreadResult& end) noexcept;

// For a service side that has failed: presses the stop and lets ticks go on until the drives are off, for at most
// `limit_ticks`. `next` runs or awaits a tick and returns false when there will be no further one.
template <class Arm>
void stop_without_service(ArmMailbox<Arm>& link, std::uint64_t limit_ticks, const std::function<bool()>& next);

}  // namespace liana::realtime
