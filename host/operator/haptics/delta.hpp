// Kinematics of a delta: three actuated legs hold a platform that never turns. Closed forms, no heap, no iteration.
//
// Frame: origin in the middle of the base, x along its axis to the platform; leg i stands in the plane of x and of
// r_i = (0, cos 120 i, sin 120 i) deg. Its upper arm turns about the base circle by q_i from r_i towards x; its lower
// arm, a parallelogram, leads on to the platform. With both circles in one radius, the platform is a point:
//   elbow_i = base_m r_i + upper_m (cos q_i r_i + sin q_i x),   |p - elbow_i| = lower_m
// (R. Clavel, patent US4976582, has the mechanism.)
#pragma once

#include <array>
#include <optional>

#include "firmware_like/math/pose.hpp"

namespace liana::haptics {

using JointAngles = std::array<double, 3>;  // q_i [rad]

// Lengths of a delta, all > 0.
struct DeltaTable {
  double base_m = 0.0;   // radius of the base's circle less that of the platform's
  double upper_m = 0.0;  // upper arm, turned by the motor
  double lower_m = 0.0;  // lower arm
};

// Where the platform is; the place in front of the elbows. Nothing where the lower arms do not meet.
std::optional<Vec3> delta_position(const DeltaTable& table, const JointAngles& angles_rad) noexcept;

// The angles at which the platform is there, elbows outwards. Nothing out of reach.
std::optional<JointAngles> delta_angles(const DeltaTable& table, const Vec3& position_m) noexcept;

// Velocity of the platform for each joint's speed [m/rad]. Nothing where a leg is stretched or the lower arms are in
// one plane.
std::optional<std::array<Vec3, 3>> delta_jacobian(const DeltaTable& table, const JointAngles& angles_rad) noexcept;

// Joint torques [N m] that make the platform push with a force.
inline std::array<double, 3> delta_torques(const std::array<Vec3, 3>& jacobian, const Vec3& force_N) noexcept {
  return {dot(jacobian[0], force_N), dot(jacobian[1], force_N), dot(jacobian[2], force_N)};
}

}  // namespace liana::haptics
