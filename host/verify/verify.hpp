// Verification, twice: what the controller would do (execution capability) and how the arm would move (simulation).
#pragma once

#include "host/arbiter/speed_zone.hpp"
#include "host/verify/twin.hpp"
#include "host/verify/verdict.hpp"

namespace liana {

// Longest stop that is accepted: full speed to rest takes about 2 s with the limits of the arm (v/a + a/j + filter
// lag).
constexpr double kMaxStop_s = 3.0;

// Ticks of kMaxStop_s.
std::size_t max_stop_ticks(const RobotTable& table);

// The twin's outputs: accepted, no new fault, gate silent, tension plan and cable speed within limits.
ExecutionVerdict judge_execution(const RobotTable& table, const Candidate& candidate, const Prediction& prediction);

// The motion: joint angles and rates, tip speed (in `zone` the zone's), and rest after the command.
SimulationVerdict judge_motion(const RobotTable& table, const Candidate& candidate, const Prediction& prediction,
                               const SpeedZone& zone = {});

// Real time only: refuses when the candidate's interval has begun already (`ticks_done` is what the arm has reached).
void judge_time(const Candidate& candidate, std::uint64_t ticks_done, ExecutionVerdict& verdict);

}  // namespace liana
