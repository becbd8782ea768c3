// Friction of the joints, found while they slide: what a torque drive gets on top, so that friction neither delays a
// motion's begin nor winds up the drive's integral, which would come off after the motion's end
// (docs/explanation/force-control.md).
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/serial/robot_params.hpp"

namespace liana::serial {

constexpr double kSlides_rad_s = 5e-4;          // from this planned rate on a joint slides for sure
constexpr double kBeginsToSlide_s = 1.0;        // that its drive's integral needs to take over
constexpr double kMinSlide_s = 10.0;            // of which the mean counts: swings of a soft base are not friction
constexpr double kFrictionShare = 3.0;          // of the declared friction, the most that is believed
constexpr double kFrictionSmooth_rad_s = 3e-5;  // friction turns round over about this rate, without a step

// One joint's. What a slide shows counts from its end on: friction that followed what is felt at once would give back
// with a delay what a swing of the base does to the joint, and feed the swing.
struct JointFriction {
  double coulomb_Nm = 0.0;
  double sum_Nm = 0.0;      // felt in the slide under way, once a tick
  double rate_rad_s = 0.0;  // planned, of the tick before
  std::uint32_t ticks = 0;  // since the slide began
};
using FrictionFound = std::array<JointFriction, kMaxJoints>;

// As the table declares it.
FrictionFound declared_friction(const RobotParams& table) noexcept;

// Takes in what the gears of sliding joints give beyond `moving_Nm`, which moving the links takes. Once a tick of
// planned motion.
void find_friction(const RobotParams& table, const JointVector& rate_rad_s, const JointVector& moving_Nm,
                   const JointVector& measured_Nm, FrictionFound& found) noexcept;

// What friction takes of joints at these rates [N.m].
JointVector friction_Nm(const RobotParams& table, const FrictionFound& found, const JointVector& rate_rad_s) noexcept;

}  // namespace liana::serial
