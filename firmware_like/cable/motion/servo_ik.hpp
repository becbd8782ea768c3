// Servo IK: joint angles that follow a moving tip pose, a constant number of iterations per tick (mission, A2,
// A5 and A6).
//
// Damped least squares on the free thetas: dtheta = J^T (J J^T + mu I)^-1 e. Held thetas are removed from the iteration
// and moved only by their own profile. A free theta that would pass its limit is set onto it and removed, and the rest
// is solved again. What the tip leaves free is moved by motion/shape.hpp. Outcomes and ways out:
// docs/explanation/architecture.md.
//
// mu = kDamping + c |e| for a target that is followed. The tip's path bends by c = kTipCurvature_m per rad2; where an
// error e cannot be taken away, as just beyond the stretched arm, a step with less damping than c |e| overshoots, and
// the next one jumps back. mu = kDamping
// + e.e for goals, where far jumps are what helps.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/math/ik_outcome.hpp"

namespace liana::cable {

constexpr std::int32_t kLimitPasses = 3;  // re-solves per iteration, at most
constexpr double kDamping = 1e-6;         // m2/rad2; singular directions slow down below |sigma| = 1e-3
constexpr double kTipCurvature_m =
    200.0;  // per rad2: eight joints turn by one theta, 64 times the length behind them; less at the tip
constexpr double kIkConverged = 1e-6;    // m and rad
constexpr double kIkBlockedShare = 0.5;  // of the error that a step leaves: more is not on its way any more

struct IkGoal {
  Pose tip_in_base{};
  std::uint32_t held_mask = 0;    // bit i: theta i is not free
  double curvature_m = 0.0;       // kTipCurvature_m to follow a moving target; 0 for a goal that may be far away
  std::array<double, 6> later{};  // of the error, as a residual: what follow_ik leaves to later ticks
};

struct IkResult {
  double position_error_m = 0.0;
  double attitude_error_rad = 0.0;
  IkOutcome outcome = IkOutcome::kConverged;
  std::array<double, 6> residual{};  // goal less tip, base frame: position [m], rotation vector [rad]
  std::uint32_t limit_mask = 0;      // bit i: theta i was stopped by its limit
};

// One damped step of the free thetas towards the goal; limits respected exactly. Reports the tip error before the step.
IkResult ik_step(const RobotParams& table, const IkGoal& goal, double damping, ThetaVector& theta_rad) noexcept;

// What a goal search does: a damped step from `arm`, then a correction with the same factors for what curvature left.
// `theta_rad` may be off `arm` by a small null-space move. Reports the tip error before the correction. Cost: one
// factorisation per limit pass, one tip pose.
IkResult servo_ik(const RobotParams& table, const IkGoal& goal, const ArmKinematics& arm,
                  ThetaVector& theta_rad) noexcept;

// What a tick does: a damped step alone, from `theta_rad`, which may be off the angles of `arm` (`arm_rad`) by a tick's
// motion. What it leaves is part of the next tick's error: 1e-6 m at full speed. Cost: one factorisation per limit
// pass.
struct FollowStep {
  double asked2 = 0.0, left2 = 0.0;  // squared error before the step, and what it is expected to leave
  std::uint32_t limit_mask = 0;      // as in IkResult
};
struct FollowBounds {
  ThetaVector arm_rad{};             // of `arm`
  ThetaVector min_rad{}, max_rad{};  // where theta may go: within its limits, and so near that it can brake
};
FollowStep follow_ik(const RobotParams& table, const IkGoal& goal, const ArmKinematics& arm, const FollowBounds& bounds,
                     ThetaVector& theta_rad) noexcept;

// What became of it, with the kinematics at the angles that the arm then took.
constexpr double kIkFollowed = 1e-5;  // m and rad: less is as good as there
IkResult follow_report(const RobotParams& table, const IkGoal& goal, const ArmKinematics& arm,
                       const FollowStep& step) noexcept;

}  // namespace liana::cable
