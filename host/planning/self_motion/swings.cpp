#include "host/planning/self_motion/swings.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/kinematics.hpp"

namespace liana::self_motion {
namespace {

// Of the frame that the first arm stands in.
struct Axis {
  Vec3 point_m{};
  Vec3 direction{};
};

// Joints of the chain so far, and what they move.
struct Moved {
  std::vector<Axis> axes;
  Eigen::MatrixXd mass;  // of joint rates: twice the kinetic energy

  explicit Moved(Eigen::Index joints) : mass(Eigen::MatrixXd::Zero(joints, joints)) {}

  // A body that all joints so far move.
  void add(const serial::LinkMass& body) {
    for (std::size_t j = 0; j < axes.size(); ++j) {
      for (std::size_t k = 0; k < axes.size(); ++k) {
        const double straight = dot(velocity(axes[j], body.center_m), velocity(axes[k], body.center_m));
        const double turning = dot(axes[j].direction, serial::inertia_times(body, axes[k].direction));
        mass(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k)) += body.mass_kg * straight + turning;
      }
    }
  }

  // Of a point for a rate of 1.
  static Vec3 velocity(const Axis& axis, const Vec3& point_m) {
    return cross(axis.direction, subtract(point_m, axis.point_m));
  }
};

// The frame at the end of link `link` (0-based) in the arm's base.
Pose frame_of(const SpringyArm& arm, std::size_t link) {
  serial::RobotParams so_far = arm.table;
  so_far.joint_count = static_cast<std::int32_t>(link) + 1;
  return serial::forward_kinematics(so_far, arm.joint_rad).tip_in_base;
}

// Adds an arm that stands at `root`; its tip is returned.
Pose add_arm(const SpringyArm& arm, const Pose& root, const serial::LinkMass& load, Moved& moved) {
  Pose before = root;
  for (std::size_t i = 0; i < arm.table.joints(); ++i) {
    moved.axes.push_back({before.position_m, rotate(before.quaternion, {0.0, 0.0, 1.0})});
    before = compose(root, frame_of(arm, i));
    moved.add(serial::moved(arm.masses.link[i], before));
  }
  moved.add(serial::moved(load, before));
  return before;
}

}  // namespace

// M as seen from springs that are all of stiffness 1: its eigenvalues are 1 / w^2, 0 for what has no inertia.
std::vector<double> swing_periods_s(std::span<const SpringyArm> chain, const serial::LinkMass& load) {
  std::vector<double> softness;
  for (const SpringyArm& arm : chain) {
    for (std::size_t i = 0; i < arm.table.joints(); ++i) softness.push_back(1.0 / std::sqrt(arm.stiffness_Nm_rad[i]));
  }
  const auto joints = static_cast<Eigen::Index>(softness.size());
  Moved moved(joints);
  Pose root;
  for (std::size_t i = 0; i < chain.size(); ++i)
    root = add_arm(chain[i], root, i + 1 == chain.size() ? load : serial::LinkMass{}, moved);
  const Eigen::Map<const Eigen::VectorXd> soft(softness.data(), joints);
  const Eigen::MatrixXd scaled = soft.asDiagonal() * moved.mass * soft.asDiagonal();
  const Eigen::VectorXd squares =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues();
  std::vector<double> periods_s;
  for (Eigen::Index i = joints; i-- > 0;)
    periods_s.push_back(2.0 * std::numbers::pi * std::sqrt(std::max(0.0, squares[i])));
  return periods_s;
}

}  // namespace liana::self_motion
