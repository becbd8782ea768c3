#include "host/planning/workspace/push.hpp"

#include <Eigen/SVD>
#include <cmath>

#include "firmware_like/math/scalar.hpp"
#include "host/base/eigen/thetas.hpp"

namespace liana::workspace {
namespace {

constexpr int kReachIterations = 30;
constexpr int kClimbSteps = 400;
constexpr double kMinDamping = 1e-9;  // m2/rad2
constexpr double kOnLimit_rad = 1e-9;

using AngleMask = std::uint32_t;
using AngleJacobian = Eigen::Matrix<double, 3, kMaxAngles>;

// Step J^T (J J^T + mu I)^-1 error of the angles in `active`.
AngleVector damped_step(const PointMotion& motion, AngleMask active, const Vec3& error_m, double damping) {
  eigen::SpaceColumns J = eigen::view(motion.column, kMaxAngles);
  for (Eigen::Index i = 0; i < J.cols(); ++i) {
    if ((active >> i & 1u) == 0) J.col(i).setZero();
  }
  const Eigen::Matrix3d A = J * J.transpose() + damping * Eigen::Matrix3d::Identity();
  AngleVector step{};
  eigen::view(step, kMaxAngles) = J.transpose() * A.llt().solve(eigen::view(error_m));
  return step;
}

// -1 at the low end of its range, +1 at the high end, else 0; an angle whose range holds a turn goes on behind it.
double limit_side(const ReachArm& arm, const AngleVector& angle_rad, std::size_t i) {
  const AngleRange& range = arm.range[i];
  if (holds_a_turn(range)) return 0.0;
  if (angle_rad[i] <= range.low_rad + kOnLimit_rad) return -1.0;
  return angle_rad[i] >= range.high_rad - kOnLimit_rad ? 1.0 : 0.0;
}

AngleMask free_mask(const ReachArm& arm, const PointOnArm& point) {
  AngleMask mask = 0;
  for (std::size_t i = 0; i < kMaxAngles; ++i) mask |= is_free(arm, point, i) ? 1u << i : 0u;
  return mask;
}

// The angles of `step` that stand on a limit and would pass it.
AngleMask leaving(const ReachArm& arm, const AngleVector& angle_rad, const AngleVector& step) {
  AngleMask mask = 0;
  for (std::size_t i = 0; i < kMaxAngles; ++i) mask |= step[i] * limit_side(arm, angle_rad, i) > 0.0 ? 1u << i : 0u;
  return mask;
}

void apply(const ReachArm& arm, const AngleVector& step, AngleVector& angle_rad) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i)
    angle_rad[i] = into_range(arm.range[i], angle_rad[i] + step[i]);
}

// One step towards the target; angles that would leave their limit are taken out and the rest is solved again.
void step_towards(const ReachArm& arm, const PointMotion& motion, AngleMask active, const Vec3& error_m,
                  AngleVector& angle_rad) {
  const double damping = dot(error_m, error_m) + kMinDamping;
  for (int pass = 0; pass <= kMaxAngles; ++pass) {
    const AngleVector step = damped_step(motion, active, error_m, damping);
    const AngleMask out = leaving(arm, angle_rad, step);
    if (out == 0) return apply(arm, step, angle_rad);
    active &= ~out;
  }
}

// The direction that the angles off their limits move the point least in, on the side of `direction`; `direction` where
// there is none.
Vec3 wall_normal(const ReachArm& arm, const PointMotion& motion, Eigen::Index dimensions, const Vec3& direction,
                 const AngleVector& angle_rad) {
  AngleJacobian J = eigen::view(motion.column, kMaxAngles);
  for (std::size_t i = 0; i < kMaxAngles; ++i) {
    if (limit_side(arm, angle_rad, i) != 0.0) J.col(static_cast<Eigen::Index>(i)).setZero();
  }
  const Eigen::JacobiSVD<AngleJacobian> svd(J, Eigen::ComputeFullU);
  if (svd.singularValues()[dimensions - 2] < 1e-6) return direction;  // too few ways to move: no wall
  const Eigen::Vector3d across = svd.matrixU().col(dimensions - 1);   // a flat axis has the value 0 and comes behind
  const double side = across.dot(eigen::view(direction));
  return std::fabs(side) < 0.1 ? direction : scale({across[0], across[1], across[2]}, side > 0.0 ? 1.0 : -1.0);
}

// Damped Gauss-Newton towards a position, from and to `angle_rad`; true when it is reached within 30 iterations.
bool approach(const ReachArm& arm, const PointOnArm& point, const Vec3& target_in_base_m, AngleVector& angle_rad) {
  const AngleMask active = free_mask(arm, point);
  for (int iteration = 0; iteration < kReachIterations; ++iteration) {
    const PointMotion motion = point_motion(arm, point, angle_rad);
    const Vec3 error_m = subtract(target_in_base_m, motion.point_in_base_m);
    if (norm(error_m) <= kReachTolerance_m) return true;
    step_towards(arm, motion, active, error_m, angle_rad);
  }
  return false;
}

// The limits that hold the point back at these very angles.
AngleMask limits_at(const ReachArm& arm, const PointOnArm& point, const Vec3& direction, const AngleVector& angle_rad) {
  const PointMotion motion = point_motion(arm, point, angle_rad);
  const Vec3 normal = wall_normal(arm, motion, point.flat_axis < 0 ? 3 : 2, direction, angle_rad);
  AngleMask mask = 0;
  for (std::size_t i = 0; i < kMaxAngles; ++i) {
    const double side = is_free(arm, point, i) ? limit_side(arm, angle_rad, i) : 0.0;
    if (side * dot(motion.column[i], normal) > 1e-9) mask |= 1u << i;
  }
  return mask;
}

}  // namespace

bool is_free(const ReachArm& arm, const PointOnArm& point, std::size_t angle) {
  return angle < static_cast<std::size_t>(arm.angles_to[static_cast<std::size_t>(point.node)]) &&
         (point.held_mask >> angle & 1u) == 0;
}

PointMotion point_motion(const ReachArm& arm, const PointOnArm& point, const AngleVector& angle_rad) {
  PointMotion motion = arm.motion(point.node, angle_rad);
  for (std::size_t i = 0; i < kMaxAngles; ++i) {
    if (!is_free(arm, point, i)) motion.column[i] = {};
  }
  if (point.flat_axis < 0) return motion;
  const auto flat = static_cast<std::size_t>(point.flat_axis);
  motion.point_in_base_m[flat] = 0.0;
  for (Vec3& column : motion.column) column[flat] = 0.0;
  return motion;
}

bool reach_position(const ReachArm& arm, const PointOnArm& point, const Vec3& target_in_base_m,
                    AngleVector& angle_rad) {
  AngleVector trial = angle_rad;
  if (!approach(arm, point, target_in_base_m, trial)) return false;
  angle_rad = trial;
  return true;
}

void push_along_ray(const ReachArm& arm, const PointOnArm& point, const Vec3& origin_in_base_m, double sign,
                    AngleVector& angle_rad) {
  const Vec3 start_m = subtract(point_motion(arm, point, angle_rad).point_in_base_m, origin_in_base_m);
  double distance_m = norm(start_m);
  if (distance_m < kPushResolution_m) return;
  const Vec3 ray = scale(start_m, 1.0 / distance_m);
  const auto target_m = [&](double along_m) { return add(origin_in_base_m, scale(ray, along_m)); };
  for (double step_m = kPushStep_m; step_m >= kPushResolution_m / 2.0; step_m /= 2.0) {
    // The arm's length bounds the number of steps outwards, the origin that inwards.
    while (distance_m + sign * step_m >= 0.0 &&
           reach_position(arm, point, target_m(distance_m + sign * step_m), angle_rad)) {
      distance_m += sign * step_m;
    }
  }
}

void climb(const ReachArm& arm, const PointOnArm& point, const Vec3& direction, AngleVector& angle_rad) {
  double step_m = kPushStep_m;
  for (int i = 0; i < kClimbSteps && step_m > 1e-6; ++i) {
    const PointMotion motion = point_motion(arm, point, angle_rad);
    AngleVector slope{};
    for (std::size_t k = 0; k < kMaxAngles; ++k) slope[k] = dot(motion.column[k], direction);
    const AngleMask out = leaving(arm, angle_rad, slope);
    double steepness = kMinDamping;
    for (std::size_t k = 0; k < kMaxAngles; ++k) {
      if (out >> k & 1u) slope[k] = 0.0;
      steepness += slope[k] * slope[k];
    }
    for (double& s : slope) s *= step_m / steepness;
    AngleVector trial = angle_rad;
    apply(arm, slope, trial);
    const double gain_m =
        dot(subtract(point_motion(arm, point, trial).point_in_base_m, motion.point_in_base_m), direction);
    if (gain_m > 0.0) {
      angle_rad = trial;
      step_m *= 1.5;
    } else {
      step_m /= 4.0;
    }
  }
}

std::uint32_t binding_limits(const ReachArm& arm, const PointOnArm& point, const Vec3& direction,
                             const AngleVector& angle_rad) {
  const std::uint32_t here = limits_at(arm, point, direction, angle_rad);
  if (here != 0) return here;
  AngleVector pressed = angle_rad;
  const Vec3 ahead_m = scale(direction, kPushResolution_m);
  approach(arm, point, add(point_motion(arm, point, angle_rad).point_in_base_m, ahead_m), pressed);
  return limits_at(arm, point, direction, pressed);
}

}  // namespace liana::workspace
