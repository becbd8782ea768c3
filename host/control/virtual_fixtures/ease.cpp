#include "host/control/virtual_fixtures/ease.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "host/base/eigen/thetas.hpp"

namespace liana::virtual_fixtures {
namespace {

using Index = std::size_t;
using Row6 = Eigen::Matrix<double, 6, 1>;
using Rows6 = Eigen::Matrix<double, 6, kMaxTheta>;

constexpr double kStill = 1e-4;           // m and rad: a goal nearer than this is reached
constexpr double kLookAhead_rad = 0.003;  // of the angle that turns most: one that turns far less is not on its way
constexpr double kDamped = 1e-4;          // m2/rad2: directions that are all but lost ask for no wild angles

Rows6 free_jacobian(const RobotParams& table, const ArmKinematics& arm, std::uint32_t held_mask) {
  Rows6 J = Rows6::Zero();
  const Eigen::Index n = eigen::theta_count(table);
  J.topLeftCorner(3, n) = eigen::view(arm.tip_jacobian.linear, n);
  J.bottomLeftCorner(3, n) = eigen::view(arm.tip_jacobian.angular, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    if ((held_mask >> k & 1u) != 0) J.col(k).setZero();
  }
  return J;
}

Row6 way_to(const Pose& goal, const Pose& tip) {
  const Vec3 move = subtract(goal.position_m, tip.position_m);
  const Vec3 turn = rotation_vector(multiply(goal.quaternion, conjugate(tip.quaternion)));
  Row6 way;
  way << eigen::view(move), eigen::view(turn);
  return way;
}

// From 1 where there is `from` left to the least share where there is `to`.
double share_of(double left, double to, double from) {
  return std::clamp(kMinShare + (1.0 - kMinShare) * (left - to) / (from - to), kMinShare, 1.0);
}

}  // namespace

Ease ease(const RobotParams& table, const ThetaVector& theta_rad, std::uint32_t held_mask, const Pose& goal_in_base) {
  const ArmKinematics arm = forward_kinematics(table, theta_rad);
  const Row6 way = way_to(goal_in_base, arm.tip_in_base);
  if (way.norm() < kStill) return {};
  const Rows6 J = free_jacobian(table, arm, held_mask);
  const Eigen::Matrix<double, 6, 6> damped = J * J.transpose() + kDamped * Eigen::Matrix<double, 6, 6>::Identity();
  Eigen::Matrix<double, kMaxTheta, 1> step = J.transpose() * damped.llt().solve(way);
  const double largest = step.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return {};
  step *= kLookAhead_rad / largest;

  Ease out;
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const double move_rad = step[static_cast<Eigen::Index>(k)];
    if (std::fabs(move_rad) < 0.05 * kLookAhead_rad || move_rad * theta_rad[k] <= 0.0) continue;  // not towards it
    const double left_rad = table.segment[k / 2].theta_limit_rad - std::fabs(theta_rad[k]);
    const double share = share_of(left_rad, 0.0, kEaseFrom_rad);
    if (share < out.share) out = {share, SlowdownCause::kJointLimit, static_cast<std::int32_t>(k) + 1};
  }
  return out;
}

}  // namespace liana::virtual_fixtures
