#include "firmware_like/serial/servo_ik.hpp"

#include <cmath>

#include "firmware_like/math/cholesky.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::serial {
namespace {

using Index = std::size_t;
using Task = std::array<double, 6>;

constexpr double kBlockedShare = 0.5;  // of the error that a tick leaves: more is not on its way any more

bool is_set(std::uint32_t mask, Index i) noexcept { return ((mask >> i) & 1u) != 0; }

double size(const Task& e) noexcept {
  return std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
}

Task column(const Jacobian& J, Index i) noexcept {
  return {J.linear[i][0], J.linear[i][1], J.linear[i][2], J.angular[i][0], J.angular[i][1], J.angular[i][2]};
}

void take_motion(const Task& column, double moved_rad, Task& e) noexcept {
  for (Index r = 0; r < 6; ++r) e[r] -= column[r] * moved_rad;
}

// J J^T + damping I over the joints that are not fixed, factored; false when it cannot be.
bool factor_task(const Jacobian& J, Index joints, std::uint32_t fixed, double damping,
                 SquareMatrix<6>& factor) noexcept {
  factor = {};
  for (Index i = 0; i < joints; ++i) {
    if (is_set(fixed, i)) continue;
    const Task c = column(J, i);
    for (Index r = 0; r < 6; ++r) {
      for (Index k = 0; k <= r; ++k) factor[r][k] += c[r] * c[k];
    }
  }
  for (Index r = 0; r < 6; ++r) factor[r][r] += damping;
  return cholesky_factor(factor);
}

// z + J^T (J J^T + mu I)^-1 (e - J z) of the joints that are not fixed.
JointVector damped_step(const Jacobian& J, Index joints, std::uint32_t fixed, double damping,
                        const JointVector& wish_rad, Task e) noexcept {
  JointVector step{};
  SquareMatrix<6> factor;
  if (!factor_task(J, joints, fixed, damping, factor)) return step;
  for (Index i = 0; i < joints; ++i) {
    if (!is_set(fixed, i)) take_motion(column(J, i), wish_rad[i], e);
  }
  cholesky_solve(factor, e);
  for (Index i = 0; i < joints; ++i) {
    if (is_set(fixed, i)) continue;
    const Task c = column(J, i);
    step[i] = wish_rad[i] + c[0] * e[0] + c[1] * e[1] + c[2] * e[2] + c[3] * e[3] + c[4] * e[4] + c[5] * e[5];
  }
  return step;
}

// Sets joints that the step would carry out of their range onto its end and takes their motion from e; returns which.
std::uint32_t stop_at_ranges(const RobotParams& table, const Jacobian& J, const JointVector& step,
                             JointVector& joint_rad, Task& e) noexcept {
  std::uint32_t stopped = 0;
  for (Index i = 0; i < table.joints(); ++i) {
    const double wanted = joint_rad[i] + step[i];
    const double bound = clamp(wanted, table.joint[i].low_rad, table.joint[i].high_rad);
    if (bound == wanted) continue;
    take_motion(column(J, i), bound - joint_rad[i], e);
    joint_rad[i] = bound;
    stopped |= 1u << i;
  }
  return stopped;
}

// One damped step; returns the joints that were stopped at their ranges.
std::uint32_t iterate(const RobotParams& table, const Jacobian& J, double damping, const JointVector& wish_rad, Task e,
                      JointVector& joint_rad) noexcept {
  std::uint32_t fixed = 0;
  for (std::int32_t pass = 0; pass < kRangePasses; ++pass) {
    const JointVector step = damped_step(J, table.joints(), fixed, damping, wish_rad, e);
    const std::uint32_t stopped = stop_at_ranges(table, J, step, joint_rad, e);
    if (stopped == 0) {
      for (Index i = 0; i < table.joints(); ++i) joint_rad[i] += step[i];  // 0 for fixed ones
      break;
    }
    fixed |= stopped;  // too many at once: the rest waits for the next iteration
  }
  return fixed;
}

IkOutcome outcome_of(const RobotParams& table, const Pose& goal, const IkResult& report, double asked) noexcept {
  if (report.position_error_m <= kIkConvergedError && report.attitude_error_rad <= kIkConvergedError)
    return IkOutcome::kConverged;
  if (norm(goal.position_m) > chain_length_m(table)) return IkOutcome::kUnreachable;
  if (size(report.residual) <= kBlockedShare * asked) return IkOutcome::kApproaching;
  return report.limit_mask != 0 ? IkOutcome::kLimited : IkOutcome::kSingular;
}

IkResult report_of(const RobotParams& table, const Pose& goal, const Pose& tip, double asked,
                   std::uint32_t limit_mask) noexcept {
  IkResult report;
  report.residual = pose_error(goal, tip);
  const Task& e = report.residual;
  report.position_error_m = norm({e[0], e[1], e[2]});
  report.attitude_error_rad = norm({e[3], e[4], e[5]});
  report.limit_mask = limit_mask;
  report.outcome = outcome_of(table, goal, report, asked);
  return report;
}

}  // namespace

IkResult servo_ik(const RobotParams& table, const Pose& goal, const JointVector& wish_rad,
                  JointVector& joint_rad) noexcept {
  JointVector wish = wish_rad;
  std::uint32_t limit_mask = 0;
  ArmKinematics arm = forward_kinematics(table, joint_rad);
  Task e = pose_error(goal, arm.tip_in_base);
  const double asked = size(e);
  for (std::int32_t i = 0; i < kIkIterations; ++i) {
    const double damping = kIkDamping + chain_length_m(table) * size(e);
    limit_mask |= iterate(table, arm.tip_jacobian, damping, wish, e, joint_rad);
    arm = forward_kinematics(table, joint_rad);
    e = pose_error(goal, arm.tip_in_base);
    wish = {};  // granted once; the other iterations only bring the tip to its goal
  }
  return report_of(table, goal, arm.tip_in_base, asked, limit_mask);
}

double far_step(const RobotParams& table, const Pose& goal, JointVector& joint_rad) noexcept {
  const ArmKinematics arm = forward_kinematics(table, joint_rad);
  const Task e = pose_error(goal, arm.tip_in_base);
  iterate(table, arm.tip_jacobian, kIkDamping + size(e) * size(e), {}, e, joint_rad);
  return size(e);
}

JointVector rates_of_twist(const RobotParams& table, const Jacobian& jacobian, const Twist& twist) noexcept {
  const Vec3 &v = twist.linear_m_s, &w = twist.angular_rad_s;
  return damped_step(jacobian, table.joints(), 0, kIkDamping, {}, {v[0], v[1], v[2], w[0], w[1], w[2]});
}

IkResult report_ik(const RobotParams& table, const Pose& goal, const Pose& tip) noexcept {
  const double asked = 4.0 * size(pose_error(goal, tip));  // nothing was tried, so nothing is in its way
  return report_of(table, goal, tip, asked, 0);
}

}  // namespace liana::serial
