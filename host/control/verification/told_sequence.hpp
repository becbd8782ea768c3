// What the second end simulates of a prediction: what the drives are told, in rows an interval apart.
#pragma once

#include "host/control/arbiter/serial_traits.hpp"
#include "host/control/verification/twin.hpp"
#include "host/model/simulation/swinging_arm.hpp"

namespace liana::verification {

constexpr double kEnough_m = 0.1;  // farther from the scene nobody asks how far

// Every T_c what the drives are told: now, then at the end of each interval that the twin has looked into.
template <class Arm>
void read_sequence(const TwinSnapshot<Arm>& image, std::uint64_t first_tick, const Prediction<Arm>& prediction,
                   simulation::ToldRows<arbiter::Joints<Arm>>& out);
// The same of a cable arm, with what its tensions are planned to do at the rows.
void read_sequence(const TwinSnapshot<cable::CableArm>& image, std::uint64_t first_tick,
                   const Prediction<cable::CableArm>& prediction, simulation::JointSequence& out);

// What the drives are told in the tick of these outputs.
simulation::ToldNow told_now(const cable::RobotParams& table, const cable::Outputs& now);

}  // namespace liana::verification
