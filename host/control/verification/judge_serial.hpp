// The second end's verdict on a serial arm: the simulated motion against scene, arm and ranges.
#pragma once

#include "host/control/verification/judge_distances.hpp"
#include "host/model/simulation/serial_simulation.hpp"

namespace liana::verification {

// What is told is held against ranges and rates as they are; the simulated tip may be half as fast again as its limit,
// since it catches up with what it is behind. Adds margins, what comes first and a refusal (201, 202, 203, 205, 208,
// 209) to `verdict`; where there are no bodies clearance_m stays as it is. About 100 instructions a row.
void judge_serial(const serial::RobotParams& table, const simulation::SerialSimulation& simulation,
                  const simulation::ToldRows<serial::JointVector>& told, const simulation::SerialMotion& motion,
                  TooNear& too_near, SimulationVerdict& verdict);

}  // namespace liana::verification
