// The core's vectors seen as vectors of Eigen, and the small equations of joint angles that planner and reach solve.
// Nothing here allocates.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <array>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana::eigen {

using namespace cable;  // this room serves the cable arm only

// A number per theta of the robot, one per pair of thetas, and a vector in space per theta.
using ThetaColumn = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxTheta, 1>;
using ThetaMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMaxTheta, kMaxTheta>;
using SpaceColumns = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxTheta>;

inline Eigen::Index theta_count(const RobotParams& table) { return table.theta_count(); }

// Views, not copies: of the first `count` thetas, of a vector, of the first `count` columns.
inline Eigen::Map<const Eigen::VectorXd> view(const ThetaVector& theta, Eigen::Index count) {
  return {theta.data(), count};
}
inline Eigen::Map<Eigen::VectorXd> view(ThetaVector& theta, Eigen::Index count) { return {theta.data(), count}; }
inline Eigen::Map<const Eigen::Vector3d> view(const Vec3& v) { return Eigen::Map<const Eigen::Vector3d>(v.data()); }
inline Eigen::Map<const Eigen::Matrix3Xd> view(const std::array<Vec3, kMaxTheta>& columns, Eigen::Index count) {
  return {columns.front().data(), 3, count};
}

// Replaces equation k of A x = b by x_k = value, and takes its share out of the others; A stays symmetric.
inline void fix_theta(Eigen::Index k, double value, ThetaMatrix& A, ThetaColumn& b) {
  b -= value * A.col(k);
  A.row(k).setZero();
  A.col(k).setZero();
  A(k, k) = 1.0;
  b[k] = value;
}

}  // namespace liana::eigen
