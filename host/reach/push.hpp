// Moving one point of the arm as far as it goes: position only, attitude free, held thetas still, limits exact.
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"

namespace liana::reach {

using namespace cable;  // this room serves the cable arm only

constexpr double kReachTolerance_m = 1e-6;  // a target is reached when the point is this near
constexpr double kPushStep_m = 0.2;         // first step of a push
constexpr double kPushResolution_m =
    1e-3;  // and the last one: a push ends less than this before where the solver cannot follow

// What is moved and what may move it.
struct PointOnArm {
  std::int32_t node = 0;        // 1..segment_count, the end of that segment; segment_count = the tip
  std::uint32_t held_mask = 0;  // bit i: theta i stays
  std::int32_t flat_axis =
      -1;  // 0..2: seen along this base axis, the point and its motion count as 0 there; -1: seen in space
};

// Where the point is seen, and its velocity per theta rate; columns of held thetas and of segments beyond the node are
// 0.
struct PointMotion {
  Vec3 point_in_base_m{};
  std::array<Vec3, kMaxTheta> column{};  // m/rad
};
PointMotion point_motion(const RobotTable& table, const PointOnArm& point, const ThetaVector& theta_rad);

// True when theta i moves the point and is not held.
bool is_free(const PointOnArm& point, std::size_t theta);

// Largest |theta i| of the robot [rad].
double theta_limit_rad(const RobotTable& table, std::size_t theta);

// Damped Gauss-Newton from `theta_rad` to a position; false, with theta_rad unchanged, when it is not reached within 30
// iterations.
bool reach_position(const RobotTable& table, const PointOnArm& point, const Vec3& target_in_base_m,
                    ThetaVector& theta_rad);

// Moves the point along its own ray from `origin_in_base_m`, outwards (sign +1) or inwards (-1), in steps of 0.2 m
// halved down to 1 mm. The result is reached by angles within limits, so the true end of the ray lies there or beyond.
void push_along_ray(const RobotTable& table, const PointOnArm& point, const Vec3& origin_in_base_m, double sign,
                    ThetaVector& theta_rad);

// Moves the point as far as it goes in a direction (unit vector), sideways motion free: rising steps along the
// gradient, at most 400.
void climb(const RobotTable& table, const PointOnArm& point, const Vec3& direction, ThetaVector& theta_rad);

// The limits that stop the point from going further in `direction` (unit vector): thetas on their limit (1e-9 rad)
// whose release would let it pass the wall that the other thetas leave. The wall is the direction that those move the
// point least in. Bit i: theta i; 0: no limit, the arm is stretched out or folded.
std::uint32_t binding_limits(const RobotTable& table, const PointOnArm& point, const Vec3& direction,
                             const ThetaVector& theta_rad);

}  // namespace liana::reach
