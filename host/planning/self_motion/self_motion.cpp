#include "host/planning/self_motion/self_motion.hpp"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "firmware_like/serial/kinematics.hpp"

namespace liana::self_motion {
namespace {

constexpr Eigen::Index kJoints = 7;
constexpr int kCorrections = 4;        // Newton's method: the second is below a nanometre, two more cost little
constexpr double kSingular = 1e-6;     // below it the null space has no one direction
constexpr std::size_t kMinSteps = 10;  // before it can be back

using Joints = Eigen::Matrix<double, kJoints, 1>;
using Jacobian = Eigen::Matrix<double, 6, kJoints>;
using Decomposition = Eigen::JacobiSVD<Jacobian>;

Eigen::Vector3d column(const Vec3& v) { return {v[0], v[1], v[2]}; }

Jacobian jacobian_of(const serial::ArmKinematics& arm) {
  Jacobian matrix;
  for (Eigen::Index i = 0; i < kJoints; ++i) {
    const auto at = static_cast<std::size_t>(i);
    matrix.col(i) << column(arm.tip_jacobian.linear[at]), column(arm.tip_jacobian.angular[at]);
  }
  return matrix;
}

Eigen::Matrix3d axes_of(const Pose& pose) {
  Eigen::Matrix3d axes;
  for (Eigen::Index k = 0; k < 3; ++k) {
    Vec3 unit{};
    unit[static_cast<std::size_t>(k)] = 1.0;
    axes.col(k) = column(rotate(pose.quaternion, unit));
  }
  return axes;
}

// What turns `from` into `to`, as half the sum of the cross products of their axes: exact to the second order, which is
// all that correcting a small difference needs.
Eigen::Vector3d turn_between(const Eigen::Matrix3d& from, const Eigen::Matrix3d& to) {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();
  for (Eigen::Index k = 0; k < 3; ++k) turn += 0.5 * from.col(k).cross(to.col(k));
  return turn;
}

class Walk {
 public:
  Walk(const serial::RobotParams& table, const serial::JointVector& stiffness_Nm_rad,
       const serial::JointVector& start_rad)
      : table_(table), start_rad_(start_rad), joint_rad_(start_rad) {
    for (Eigen::Index i = 0; i < kJoints; ++i) compliance_(i) = 1.0 / stiffness_Nm_rad[static_cast<std::size_t>(i)];
    look();
    goal_m_ = column(arm_.tip_in_base.position_m);
    goal_axes_ = axes_of(arm_.tip_in_base);
    shoulder_m_ = column(arm_.point_in_base[1]);
    axis_ = (column(arm_.point_in_base[kJoints - 1]) - shoulder_m_).normalized();
    spoke_ = spoke();
    direction_ = svd_.matrixV().col(kJoints - 1);
  }

  SelfMotion all() {
    SelfMotion motion;
    motion.way.push_back(configuration());
    while (motion.way.size() < kMaxSteps && !is_singular() && !motion.closed) {
      step();
      motion.way.push_back(configuration());
      motion.closed = motion.way.size() > kMinSteps && is_back();
    }
    return motion;
  }

 private:
  void look() {
    arm_ = serial::forward_kinematics(table_, joint_rad_);
    svd_.compute(jacobian_of(arm_), Eigen::ComputeFullU | Eigen::ComputeFullV);
  }

  bool is_singular() const { return svd_.singularValues()(5) < kSingular; }

  void step() {
    Joints along = svd_.matrixV().col(kJoints - 1);
    if (along.dot(direction_) < 0.0) along = -along;
    direction_ = along;
    add(kStep_rad * along);
    for (int i = 0; i < kCorrections; ++i) add(svd_.solve(error()));
    const Eigen::Vector3d now = spoke();
    arm_angle_rad_ += std::atan2(axis_.dot(spoke_.cross(now)), spoke_.dot(now));
    spoke_ = now;
  }

  void add(const Joints& change_rad) {
    for (Eigen::Index i = 0; i < kJoints; ++i) joint_rad_[static_cast<std::size_t>(i)] += change_rad(i);
    look();
  }

  Eigen::Matrix<double, 6, 1> error() const {
    Eigen::Matrix<double, 6, 1> found;
    found << goal_m_ - column(arm_.tip_in_base.position_m), turn_between(axes_of(arm_.tip_in_base), goal_axes_);
    return found;
  }

  // From the line between shoulder and wrist to the elbow.
  Eigen::Vector3d spoke() const {
    const Eigen::Vector3d elbow = column(arm_.point_in_base[kJoints / 2]) - shoulder_m_;
    return elbow - axis_.dot(elbow) * axis_;
  }

  Configuration configuration() const {
    Configuration found;
    found.joint_rad = joint_rad_;
    found.arm_angle_rad = arm_angle_rad_;
    const Eigen::Matrix<double, 6, 1> beside = error();
    found.tip_drift_m = beside.head<3>().norm();
    found.tip_turn_rad = beside.tail<3>().cwiseAbs().maxCoeff();
    const Eigen::Matrix<double, 3, kJoints> moves =
        axes_of(arm_.tip_in_base).transpose() * jacobian_of(arm_).topRows<3>();
    const Eigen::Vector3d gives_way = moves * (compliance_.asDiagonal() * moves.row(2).transpose());
    found.deflection_m_per_N = {gives_way.x(), gives_way.y(), gives_way.z()};
    found.least_singular_value = svd_.singularValues()(5);
    found.within_ranges = is_within_ranges();
    return found;
  }

  bool is_within_ranges() const {
    for (std::size_t i = 0; i < kJoints; ++i) {
      const serial::JointParams& joint = table_.joint[i];
      const double turns = std::ceil((joint.low_rad - joint_rad_[i]) / (2.0 * kPi));
      if (joint_rad_[i] + 2.0 * kPi * turns > joint.high_rad) return false;
    }
    return true;
  }

  // Within half a step of the start: no step can pass it farther away.
  bool is_back() const {
    double square = 0.0;
    for (std::size_t i = 0; i < kJoints; ++i) {
      const double beside = std::remainder(joint_rad_[i] - start_rad_[i], 2.0 * kPi);
      square += beside * beside;
    }
    return std::sqrt(square) <= 0.51 * kStep_rad;
  }

  const serial::RobotParams& table_;
  const serial::JointVector start_rad_;
  serial::JointVector joint_rad_;
  Joints compliance_, direction_;
  serial::ArmKinematics arm_;
  Decomposition svd_;
  Eigen::Vector3d goal_m_, shoulder_m_, axis_, spoke_;
  Eigen::Matrix3d goal_axes_;
  double arm_angle_rad_ = 0.0;
};

}  // namespace

SelfMotion self_motion(const serial::RobotParams& table, const serial::JointVector& stiffness_Nm_rad,
                       const serial::JointVector& start_rad) {
  return Walk(table, stiffness_Nm_rad, start_rad).all();
}

}  // namespace liana::self_motion
