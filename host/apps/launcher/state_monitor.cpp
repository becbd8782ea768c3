#include "host/apps/launcher/state_monitor.hpp"

#include <algorithm>
#include <cstdio>

namespace liana::launcher {
namespace {

constexpr double kSaid_s = 3.0;

}  // namespace

std::optional<std::string> StateMonitor::silence(const System& system) {
  if (Clock::now() < std::max(heard_, said_) + duration(kSaid_s)) return std::nullopt;
  said_ = Clock::now();
  char since[48];
  std::snprintf(since, sizeof since,
                "no state of the arm for %.0f s: ", std::chrono::duration<double>(said_ - heard_).count());
  const std::string still = system.standing_still();
  return since + (still.empty() ? "lianad does not go on; the machine may be too busy" : still + " stopped");
}

}  // namespace liana::launcher
