// Servo IK of a serial arm: joint angles that follow a moving tip pose, a constant number of iterations per tick.
//
// Damped least squares: dq = z + J^T (J J^T + mu I)^-1 (e - J z). z is a wish for the joints that the tip leaves free
// to choose among (here the arm angle); what of it would move the tip is taken out. A joint that would pass the end of
// its range is set onto it and left out, and the others are solved again.
//
// mu = kDamping + c |e|: the tip's path bends by up to c = chain_length_m per rad2, so where an error e cannot be taken
// away, as just beyond the stretched arm, a step with less damping overshoots, and the next one jumps back.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/math/ik_outcome.hpp"
#include "firmware_like/serial/kinematics.hpp"

namespace liana::serial {

constexpr std::int32_t kIkIterations = 3;  // per tick
constexpr std::int32_t kRangePasses =
    3;  // solutions per iteration, each with the joints left out that the last one met the range of
constexpr double kIkDamping = 1e-6;         // m2/rad2; directions with a singular value below 1e-3 slow down
constexpr double kIkConvergedError = 1e-6;  // m and rad

// How far servo IK got in a tick.
struct IkResult {
  std::array<double, 6> residual{};  // goal less tip, base frame: position [m], rotation vector [rad]
  double position_error_m = 0.0;
  double attitude_error_rad = 0.0;
  IkOutcome outcome = IkOutcome::kConverged;
  std::uint32_t limit_mask = 0;  // bit i: joint i was stopped at the end of its range
};

// Moves the joints towards the goal and, with what is left free, by `wish_rad`; never beyond their ranges. The report
// is of the joints it leaves. Cost: kIkIterations factorisations of 6 x 6 and one more pass over the joints, more only
// at the ends of ranges.
IkResult servo_ik(const RobotParams& table, const Pose& tip_goal_in_base, const JointVector& wish_rad,
                  JointVector& joint_rad) noexcept;

// One step towards a goal that may be far away, for searches outside the tick: mu = kIkDamping + |e|^2, because far
// jumps are what helps there. Returns |e| (m and rad together) before the step.
double far_step(const RobotParams& table, const Pose& tip_goal_in_base, JointVector& joint_rad) noexcept;

// Joint rates [rad/s] of a twist of the tip, the smallest that there are: J^T (J J^T + kIkDamping I)^-1 v.
JointVector rates_of_twist(const RobotParams& table, const Jacobian& jacobian, const Twist& twist) noexcept;

// The report of joints that stand still.
IkResult report_ik(const RobotParams& table, const Pose& tip_goal_in_base, const Pose& tip_in_base) noexcept;

}  // namespace liana::serial
