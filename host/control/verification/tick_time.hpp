// Whether the controller's own computing fits the machine it runs on: by instructions, so that it is the same every
// day.
#pragma once

#include <string>

#include "host/control/verification/verdict.hpp"
#include "host/model/config/config.hpp"

namespace liana::verification {

// The costliest tick that the gate on instructions allows (tests/benchmarks/gate.py: 68,250 for 15 drives), which
// grows with the drives.
constexpr double kTickInstructionsPerDrive = 4550.0;

// What the predicted ticks leave of the time that the machine has for each of them; refuses when they take more.
inline void judge_tick_time(const cable::RobotParams& table, const config::Machine& machine, Verdict& verdict) {
  const double allowed_us = 1e6 * machine.tick_share * table.tick_s;
  const double taken_us = kTickInstructionsPerDrive * table.drive_count() / machine.mips;
  verdict.margins.time_us = allowed_us - taken_us;
  if (verdict.margins.time_us >= 0.0 || !verdict.passed()) return;
  verdict.code = Refusal::kTickTime;
  verdict.text = "a tick can take " + std::to_string(static_cast<int>(taken_us)) + " us on this machine, which has " +
                 std::to_string(static_cast<int>(allowed_us)) + " us for it";
}

}  // namespace liana::verification
