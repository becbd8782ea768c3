// The push of obstacles on one pose, as start paths and single poses feel it.
#pragma once

#include "host/base/eigen/thetas.hpp"
#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

// Gauss-Newton model of a cost at one pose.
struct PoseModel {
  explicit PoseModel(Eigen::Index thetas)
      : gradient(eigen::ThetaColumn::Zero(thetas)), hessian(eigen::ThetaMatrix::Zero(thetas, thetas)) {}
  double cost = 0.0;
  eigen::ThetaColumn gradient;
  eigen::ThetaMatrix hessian;
};

// Cost [m^2]: sum over links and obstacles of (wanted - distance)^2 where positive. The derivatives only when asked
// for.
PoseModel push_model(const Room& room, const ThetaVector& theta_rad, double wanted_m, bool derivatives);

}  // namespace liana::planner
