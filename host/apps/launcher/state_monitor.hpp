// When the last state came, and what people are told while none comes: every session has one.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "host/apps/launcher/system.hpp"

namespace liana::launcher {

class StateMonitor {
 public:
  // A state came, or silence begins to count anew.
  void heard() { heard_ = Clock::now(); }
  bool silent_for(double time_s) const { return Clock::now() > heard_ + duration(time_s); }
  // Where no state has come for 3 s, and again every 3 s: for how long, and which program of the system stands still.
  std::optional<std::string> silence(const System& system);

 private:
  using Clock = std::chrono::steady_clock;
  static Clock::duration duration(double time_s) {
    return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_s));
  }

  Clock::time_point heard_ = Clock::now(), said_ = heard_;
};

}  // namespace liana::launcher
