// The second end's verdict on a serial arm: the simulated motion against scene, arm and ranges.
#pragma once

#include <string>
#include <vector>

#include "host/control/verification/judge_distances.hpp"
#include "host/model/simulation/serial_simulation.hpp"

namespace liana::verification {

// What is told is held against ranges and rates as they are; the simulated tip may be half as fast again as its limit,
// since it catches up with what it is behind. Adds margins, what comes first and a refusal (201, 202, 203, 205, 208,
// 209) to `verdict`; where there are no bodies clearance_m stays as it is. About 100 instructions a row.
void judge_serial(const serial::RobotParams& table, const simulation::SerialSimulation& simulation,
                  const simulation::ToldRows<serial::JointVector>& told, const simulation::SerialMotion& motion,
                  TooNear& too_near, SimulationVerdict& verdict);

// Why the arm must not go straight from point to point in its joint angles: the first piece, and how far on it, where
// links, or what it `carries`, could touch the scene or the arm itself (208, 209 as of commands). Empty: it may. Looked
// at as it would go at half of its joints' rates; about 60,000 instructions a degree of the slowest joint.
std::string refusal_of_way(const serial::RobotParams& table, simulation::SerialSimulation& simulation,
                           const std::vector<serial::JointVector>& points_rad, bool carries);

}  // namespace liana::verification
