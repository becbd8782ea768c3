// The arm's own mass: what it takes to accelerate it, and how the arm is measured to accelerate. Without it a swing
// looks like something that pushes, and a plan of tensions lets the arm swing.
//
// Every segment is taken as a straight, even rod between its two nodes: with their velocities a and b its kinetic
// energy is m / 6 (a a + a b + b b), so that node a feels m / 6 (2 a' + b'). A bent segment's middle lies beside the
// rod: the torques are a few percent off (docs/explanation/contact-force.md).
#pragma once

#include <array>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::cable {

// Torque [N m] about each theta per rad/s2 of each: symmetric, all entries of the table's thetas are written.
using MassMatrix = std::array<ThetaVector, kMaxTheta>;

// Mass matrix [kg m2] at one pose. Cost: a column of the Jacobian per theta and node behind it, 12 operations for every
// two of them.
void update_mass_matrix(const RobotParams& table, const ArmKinematics& kinematics, MassMatrix& mass) noexcept;

// Torque [N m] about theta `axis` that this acceleration takes.
double inertia_torque_Nm(const RobotParams& table, const MassMatrix& mass, const ThetaVector& accel_rad_s2,
                         std::size_t axis) noexcept;

// An arm that is pushed accelerates, too: what the cables' torques and the mass do not balance is the push, before the
// arm has given way to it.
constexpr double kAccelerationFilter_s = 0.1;  // twice; counts and noise of tensions are 1 N m at the root behind it

struct BodyInertiaState {
  bool begun = false;
  ThetaVector slow_rad{};    // measured angles, low-passed
  ThetaVector slow_rad_s{};  // their rates, low-passed
  ThetaVector accel_rad_s2{};
  CableVector slow_N{};     // measured tensions, low-passed
  CableVector tension_N{};  // twice: as late as the acceleration
};

// Follows measured angles and tensions; to be called every `period_s`.
void follow_acceleration(const RobotParams& table, const ThetaVector& theta_rad, const CableVector& tension_N,
                         double period_s, BodyInertiaState& state) noexcept;

}  // namespace liana::cable
