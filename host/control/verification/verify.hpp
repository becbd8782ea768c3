// Verification, twice: what the controller would do (execution capability) and how the arm would move (simulation).
#pragma once

#include "host/control/arbiter/speed_zone.hpp"
#include "host/control/verification/twin.hpp"
#include "host/control/verification/verdict.hpp"

namespace liana::verification {

// Longest stop that is accepted: full speed to rest takes about 2 s with the limits of the arm (v/a + a/j + filter
// lag).
constexpr double kMaxStop_s = 3.0;

// Ticks of kMaxStop_s.
std::size_t max_stop_ticks(double tick_s);

// The twin's outputs: accepted, no new fault, gate silent, planned forces and targets within limits (arm_limits.hpp),
// joint angles, rates and tip speed too (in `zone` the zone's), rest after the command.
template <class Arm>
ExecutionVerdict judge_execution(const typename Arm::Table& table, const Candidate<Arm>& candidate,
                                 const Prediction<Arm>& prediction, const arbiter::SpeedZone& zone = {});

// The motion as the controller's own kinematics has it, without inertia and scene: all that there is of a second end
// for a serial arm.
template <class Arm>
SimulationVerdict judge_motion(const typename Arm::Table& table, const Candidate<Arm>& candidate,
                               const Prediction<Arm>& prediction, const arbiter::SpeedZone& zone = {});

// Real time only: refuses when the interval that begins at `first_tick` has begun already (`ticks_done` is what the arm
// has reached).
void judge_time(std::uint64_t first_tick, std::uint64_t ticks_done, ExecutionVerdict& verdict);

}  // namespace liana::verification
