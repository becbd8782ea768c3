// The same arm as a chain of 80 independent hinges, worked joint by joint: what the closed form and the reduced
// Jacobian save. Straightforward and without waste: one turn of two axes a hinge, no 4x4 products, no heap.
#pragma once

#include <array>
#include <cstddef>

#include "firmware_like/cable/arm/kinematics.hpp"

namespace liana::bench {

constexpr std::size_t kHinges = 80;
using HingeVector = std::array<double, kHinges>;

struct Hinge {
  std::size_t theta = 0;  // which reduced angle turns it
  bool is_pitch = true;   // about z; otherwise about y
  double link_m = 0.0;    // along x, after the turn
};
using HingeChain = std::array<Hinge, kHinges>;

// The hinges of a table of five segments with eight modules each; throws std::runtime_error on any other.
HingeChain hinge_chain(const cable::RobotParams& table);

struct HingeKinematics {
  Pose tip_in_base{};
  std::array<Vec3, kHinges> linear{};   // m/rad
  std::array<Vec3, kHinges> angular{};  // rad/rad
};

// Every hinge at the angle of its theta.
HingeVector hinge_angles(const HingeChain& chain, const cable::ThetaVector& theta_rad);

// Pose and 6x80 Jacobian; the angles of the hinges are independent.
HingeKinematics hinge_kinematics(const HingeChain& chain, const HingeVector& angle_rad);

// The same with each theta's sine and cosine taken once, and the columns of each theta summed to 6x10 (eq. 3-12 of the
// source).
cable::ArmKinematics hinge_kinematics_summed(const cable::RobotParams& table, const HingeChain& chain,
                                             const cable::ThetaVector& theta_rad);

// One step of damped least squares over 80 hinges: angle += J^T (J J^T + damping I)^-1 e, from their kinematics and the
// tip error e.
void hinge_ik_step(const HingeKinematics& arm, std::array<double, 6> e, double damping, HingeVector& angle_rad);

}  // namespace liana::bench
