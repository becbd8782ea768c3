// Moving one point of the arm as far as it goes: position only, attitude free, held angles still, ranges exact.
#pragma once

#include <cstdint>

#include "host/planning/workspace/arm.hpp"

namespace liana::workspace {

constexpr double kReachTolerance_m = 1e-6;  // a target is reached when the point is this near
constexpr double kPushStep_m = 0.2;         // first step of a push
constexpr double kPushResolution_m = 1e-3;  // and the last one: a push ends at most this before where it cannot follow

// What is moved and what may move it.
struct PointOnArm {
  std::int32_t node = 0;        // 1..node_count; node_count = the tip
  std::uint32_t held_mask = 0;  // bit i: angle i stays
  std::int32_t flat_axis =
      -1;  // 0..2: seen along this base axis, the point and its motion count as 0 there; -1: seen in space
};

// Where the point is seen, and its velocity per angle rate; columns of held angles and of those beyond the node are 0.
PointMotion point_motion(const ReachArm& arm, const PointOnArm& point, const AngleVector& angle_rad);

// True when angle i moves the point and is not held.
bool is_free(const ReachArm& arm, const PointOnArm& point, std::size_t angle);

// Damped Gauss-Newton from `angle_rad` to a position; false, with angle_rad unchanged, when it is not reached within 30
// iterations.
bool reach_position(const ReachArm& arm, const PointOnArm& point, const Vec3& target_in_base_m, AngleVector& angle_rad);

// Moves the point along its own ray from `origin_in_base_m`, outwards (sign +1) or inwards (-1), in steps of 0.2 m
// halved down to 1 mm. The result is reached by angles within limits, so the true end of the ray lies there or beyond.
void push_along_ray(const ReachArm& arm, const PointOnArm& point, const Vec3& origin_in_base_m, double sign,
                    AngleVector& angle_rad);

// Moves the point as far as it goes in a direction (unit vector), sideways motion free: rising steps along the
// gradient, at most 400.
void climb(const ReachArm& arm, const PointOnArm& point, const Vec3& direction, AngleVector& angle_rad);

// The limits that stop the point from going further in `direction` (unit vector): angles on an end of their range (1e-9
// rad) whose release would let it pass the wall that the other angles leave. The wall is the direction that those move
// the point least in. Where there is none the point is pressed 1 mm that way, as a push ends so much before its limits.
// Bit i: angle i; 0: no limit, the arm is stretched out or folded. An angle whose range holds a turn is never among
// them (holds_a_turn). Cost: at most 32 kinematics.
std::uint32_t binding_limits(const ReachArm& arm, const PointOnArm& point, const Vec3& direction,
                             const AngleVector& angle_rad);

}  // namespace liana::workspace
