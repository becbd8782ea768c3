#include "host/reach/push.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "firmware_like/math/scalar.hpp"
#include "host/algebra/thetas.hpp"

namespace liana::reach {
namespace {

constexpr int kReachIterations = 30;
constexpr int kClimbSteps = 400;
constexpr double kLeastDamping = 1e-9;  // m2/rad2
constexpr double kOnLimit_rad = 1e-9;

using ThetaMask = std::uint32_t;
using ThetaJacobian = Eigen::Matrix<double, 3, kMaxTheta>;

// Step J^T (J J^T + mu I)^-1 error of the thetas in `active`.
ThetaVector damped_step(const PointMotion& motion, ThetaMask active, const Vec3& error_m, double damping) {
  algebra::SpaceColumns J = algebra::view(motion.column, kMaxTheta);
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    if ((active >> i & 1u) == 0) J.col(i).setZero();
  }
  const Eigen::Matrix3d A = J * J.transpose() + damping * Eigen::Matrix3d::Identity();
  ThetaVector step{};
  algebra::view(step, kMaxTheta) = J.transpose() * A.llt().solve(algebra::view(error_m));
  return step;
}

bool on_limit(const RobotTable& table, const ThetaVector& theta_rad, std::size_t i) {
  return std::fabs(theta_rad[i]) >= theta_limit_rad(table, i) - kOnLimit_rad;
}

ThetaMask free_mask(const PointOnArm& point) {
  ThetaMask mask = 0;
  for (std::size_t i = 0; i < kMaxTheta; ++i) mask |= is_free(point, i) ? 1u << i : 0u;
  return mask;
}

// The thetas of `step` that stand on a limit and would pass it.
ThetaMask leaving(const RobotTable& table, const ThetaVector& theta_rad, const ThetaVector& step) {
  ThetaMask mask = 0;
  for (std::size_t i = 0; i < kMaxTheta; ++i) {
    if (step[i] * theta_rad[i] > 0.0 && on_limit(table, theta_rad, i)) mask |= 1u << i;
  }
  return mask;
}

void apply(const RobotTable& table, const ThetaVector& step, ThetaVector& theta_rad) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i) {
    const double limit = theta_limit_rad(table, i);
    theta_rad[i] = clamp(theta_rad[i] + step[i], -limit, limit);
  }
}

// One step towards the target; thetas that would leave their limit are taken out and the rest is solved again.
void step_towards(const RobotTable& table, const PointMotion& motion, ThetaMask active, const Vec3& error_m,
                  ThetaVector& theta_rad) {
  const double damping = dot(error_m, error_m) + kLeastDamping;
  for (int pass = 0; pass <= kMaxTheta; ++pass) {
    const ThetaVector step = damped_step(motion, active, error_m, damping);
    const ThetaMask out = leaving(table, theta_rad, step);
    if (out == 0) return apply(table, step, theta_rad);
    active &= ~out;
  }
}

// The direction that the thetas off their limits move the point least in, on the side of `direction`; `direction` where
// there is none.
Vec3 wall_normal(const RobotTable& table, const PointMotion& motion, Eigen::Index dimensions, const Vec3& direction,
                 const ThetaVector& theta_rad) {
  ThetaJacobian J = algebra::view(motion.column, kMaxTheta);
  for (std::size_t i = 0; i < kMaxTheta; ++i) {
    if (on_limit(table, theta_rad, i)) J.col(static_cast<Eigen::Index>(i)).setZero();
  }
  const Eigen::JacobiSVD<ThetaJacobian> svd(J, Eigen::ComputeFullU);
  if (svd.singularValues()[dimensions - 2] < 1e-6) return direction;  // too few ways to move: no wall
  const Eigen::Vector3d across = svd.matrixU().col(dimensions - 1);   // a flat axis has the value 0 and comes behind
  const double side = across.dot(algebra::view(direction));
  return std::fabs(side) < 0.1 ? direction : scale({across[0], across[1], across[2]}, side > 0.0 ? 1.0 : -1.0);
}

}  // namespace

bool is_free(const PointOnArm& point, std::size_t theta) {
  return theta < static_cast<std::size_t>(2 * point.node) && (point.held_mask >> theta & 1u) == 0;
}

double theta_limit_rad(const RobotTable& table, std::size_t theta) { return table.segment[theta / 2].theta_limit_rad; }

PointMotion point_motion(const RobotTable& table, const PointOnArm& point, const ThetaVector& theta_rad) {
  const ArmKinematics arm = forward_kinematics(table, theta_rad);
  PointMotion motion;
  motion.point_in_base_m = arm.node_in_base[static_cast<std::size_t>(point.node)].position_m;
  for (std::int32_t i = 0; i < 2 * point.node; ++i) {
    const auto index = static_cast<std::size_t>(i);
    if (is_free(point, index)) motion.column[index] = node_jacobian_column(arm, point.node, i);
  }
  if (point.flat_axis < 0) return motion;
  const auto flat = static_cast<std::size_t>(point.flat_axis);
  motion.point_in_base_m[flat] = 0.0;
  for (Vec3& column : motion.column) column[flat] = 0.0;
  return motion;
}

bool reach_position(const RobotTable& table, const PointOnArm& point, const Vec3& target_in_base_m,
                    ThetaVector& theta_rad) {
  const ThetaMask active = free_mask(point);
  ThetaVector trial = theta_rad;
  for (int iteration = 0; iteration < kReachIterations; ++iteration) {
    const PointMotion motion = point_motion(table, point, trial);
    const Vec3 error_m = subtract(target_in_base_m, motion.point_in_base_m);
    if (norm(error_m) <= kReachTolerance_m) {
      theta_rad = trial;
      return true;
    }
    step_towards(table, motion, active, error_m, trial);
  }
  return false;
}

void push_along_ray(const RobotTable& table, const PointOnArm& point, const Vec3& origin_in_base_m, double sign,
                    ThetaVector& theta_rad) {
  const Vec3 start_m = subtract(point_motion(table, point, theta_rad).point_in_base_m, origin_in_base_m);
  double distance_m = norm(start_m);
  if (distance_m < kPushResolution_m) return;
  const Vec3 ray = scale(start_m, 1.0 / distance_m);
  const auto target_m = [&](double along_m) { return add(origin_in_base_m, scale(ray, along_m)); };
  for (double step_m = kPushStep_m; step_m >= kPushResolution_m / 2.0; step_m /= 2.0) {
    // The arm's length bounds the number of steps outwards, the origin that inwards.
    while (distance_m + sign * step_m >= 0.0 &&
           reach_position(table, point, target_m(distance_m + sign * step_m), theta_rad)) {
      distance_m += sign * step_m;
    }
  }
}

void climb(const RobotTable& table, const PointOnArm& point, const Vec3& direction, ThetaVector& theta_rad) {
  double step_m = kPushStep_m;
  for (int i = 0; i < kClimbSteps && step_m > 1e-6; ++i) {
    const PointMotion motion = point_motion(table, point, theta_rad);
    ThetaVector slope{};
    for (std::size_t k = 0; k < kMaxTheta; ++k) slope[k] = dot(motion.column[k], direction);
    const ThetaMask out = leaving(table, theta_rad, slope);
    double steepness = kLeastDamping;
    for (std::size_t k = 0; k < kMaxTheta; ++k) {
      if (out >> k & 1u) slope[k] = 0.0;
      steepness += slope[k] * slope[k];
    }
    for (double& s : slope) s *= step_m / steepness;
    ThetaVector trial = theta_rad;
    apply(table, slope, trial);
    const double gain_m =
        dot(subtract(point_motion(table, point, trial).point_in_base_m, motion.point_in_base_m), direction);
    if (gain_m > 0.0) {
      theta_rad = trial;
      step_m *= 1.5;
    } else {
      step_m /= 4.0;
    }
  }
}

std::uint32_t binding_limits(const RobotTable& table, const PointOnArm& point, const Vec3& direction,
                             const ThetaVector& theta_rad) {
  const PointMotion motion = point_motion(table, point, theta_rad);
  const Vec3 normal = wall_normal(table, motion, point.flat_axis < 0 ? 3 : 2, direction, theta_rad);
  std::uint32_t mask = 0;
  for (std::size_t i = 0; i < kMaxTheta; ++i) {
    if (is_free(point, i) && on_limit(table, theta_rad, i) && dot(motion.column[i], normal) * theta_rad[i] > 1e-9)
      mask |= 1u << i;
  }
  return mask;
}

}  // namespace liana::reach
