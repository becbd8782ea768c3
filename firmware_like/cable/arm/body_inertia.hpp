// The torque that the arm's own mass asks for: without it a swing looks like something that pushes.
//
// Each segment's mass is lumped at its two ends, and each node accelerates as the measured angles do, so that the
// torque about an angle is a sum over the nodes beyond it. An arm that is pushed accelerates, too: what the cables'
// torques and this one do not balance is the push, before the arm has given way to it.
#pragma once

#include <array>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/robot_table.hpp"

namespace liana::cable {

constexpr double kAccelerationFilter_s = 0.1;  // twice; counts and noise of tensions are 1 N m at the root behind it

struct BodyInertiaState {
  bool begun = false;
  ThetaVector slow_rad{};    // measured angles, low-passed
  ThetaVector slow_rad_s{};  // their rates, low-passed
  ThetaVector accel_rad_s2{};
  CableVector slow_N{};                      // measured tensions, low-passed
  CableVector tension_N{};                   // twice: as late as the acceleration
  std::array<Vec3, kMaxSegments> force_N{};  // what accelerates each node, base frame
};

// Follows measured angles and tensions; to be called every `period_s`.
void follow_acceleration(const RobotTable& table, const ThetaVector& theta_rad, const CableVector& tension_N,
                         double period_s, BodyInertiaState& state) noexcept;

// Forces on the nodes, of the acceleration now. Cost: 15 operations per node and angle before it.
void feel_inertia(const RobotTable& table, const ArmKinematics& kinematics, BodyInertiaState& state) noexcept;

// Torque about one angle that these forces take [N m].
double inertia_torque_Nm(const RobotTable& table, const ArmKinematics& kinematics, const BodyInertiaState& state,
                         std::size_t axis) noexcept;

}  // namespace liana::cable
