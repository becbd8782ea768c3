#include "host/model/simulation/linear_arm.hpp"

#include <Eigen/Cholesky>

namespace liana::simulation {

using eigen::ThetaColumn;
using eigen::ThetaMatrix;
using Solver = Eigen::LLT<ThetaMatrix>;

bool LinearArm::solve(const ArmModel& model, const ThetaVector& about_rad, double step_s) {
  Chain chain;
  place(model, about_rad, chain);
  mass_ = mass_matrix(model, chain);
  paths_ = cable_paths(model, about_rad);
  pull_N_rad_ = paths_.stiffness_N_per_m.asDiagonal() * paths_.jacobian_m_rad;
  stiffness_ = paths_.jacobian_m_rad.transpose().lazyProduct(pull_N_rad_);
  step_s_ = step_s;
  damping_1_s_ = model.swing_damping_1_s;

  ThetaMatrix resistance =
      (1.0 + 0.5 * step_s * damping_1_s_) * mass_ + 0.25 * step_s * step_s * stiffness_;  // M + h/2 (D + c M) + h^2/4 K
  resistance.diagonal().array() += 0.5 * step_s * model.viscous_Nms_per_rad;
  const Solver moving(resistance), standing(stiffness_);
  if (moving.info() != Eigen::Success || standing.info() != Eigen::Success) return false;
  keep_ = moving.solve(mass_);
  follow_ = moving.solve(0.5 * step_s * stiffness_);
  by_torque_rad_Nm_ = standing.solve(ThetaMatrix::Identity(mass_.rows(), mass_.cols()));
  return true;
}

void LinearArm::step(const ThetaColumn& drums_rad, const ThetaColumn& told_rad, Swing& swing) const {
  const ThetaColumn push = swing.rate_rad_s + 0.5 * damping_1_s_ * told_rad;
  const ThetaColumn pull = 0.5 * (drums_rad + swing.drums_rad) - swing.theta_rad;
  ThetaColumn middle(push.size());
  middle.noalias() = keep_.lazyProduct(push);
  middle.noalias() += follow_.lazyProduct(pull);
  swing.theta_rad += step_s_ * middle;
  swing.rate_rad_s = 2.0 * middle - swing.rate_rad_s;
  swing.drums_rad = drums_rad;
}

}  // namespace liana::simulation
