// Arm and drives about one pose: inertia, elasticity and damping held constant there, the equations solved once.
//
//   M v' = -K (x - w) - D v - c M (v - u'),   w: where the drums want the angles x, u: what they are told to be
//
// D is the joints' viscous friction, c the core's damping of swings. What is left out: Coriolis forces (rates below
// 2 deg/s make them a ten-thousandth of the others), the change of M and K with the pose (Simulation solves anew after
// kNewPose_rad) and the stiffness that tension itself gives (below 1 % of K at 60 N).
#pragma once

#include "host/model/simulation/cable_paths.hpp"
#include "host/model/simulation/chain.hpp"

namespace liana::simulation {

// Angles and rates of the arm, and where the drums want the angles.
struct Swing {
  eigen::ThetaColumn theta_rad, rate_rad_s, drums_rad;
};

class LinearArm {
 public:
  // Solves the equations about a pose for steps of `step_s`; false when they have no solution (a table whose cables
  // cannot hold the arm). About 60,000 instructions for ten angles.
  bool solve(const ArmModel& model, const ThetaVector& about_rad, double step_s);

  // One step while the drums go on to `drums_rad` and the arm is told to turn by `told_rad`, which it is damped about:
  // the rule of the middle point, which neither adds energy nor takes any and is stable for steps of any length.
  void step(const eigen::ThetaColumn& drums_rad, const eigen::ThetaColumn& told_rad, Swing& swing) const;

  // By how much the drums want the angles beyond where they are to be, for cables that give this torque there.
  eigen::ThetaColumn beyond_rad(const eigen::ThetaColumn& load_Nm) const {
    return by_torque_rad_Nm_.lazyProduct(load_Nm);
  }
  // How much tighter every cable is [N] when the arm is that far from where they were planned for.
  CableColumn stretch_N(const eigen::ThetaColumn& off_rad) const { return pull_N_rad_.lazyProduct(off_rad); }
  // By how much torques that do not tell their sign may turn every angle.
  eigen::ThetaColumn band_rad(const eigen::ThetaColumn& torque_Nm) const {
    return by_torque_rad_Nm_.cwiseAbs() * torque_Nm;
  }

  const CablePaths& paths() const { return paths_; }
  const eigen::ThetaMatrix& mass() const { return mass_; }
  const eigen::ThetaMatrix& stiffness() const { return stiffness_; }

 private:
  double step_s_ = 0.0;
  double damping_1_s_ = 0.0;
  CablePaths paths_;
  eigen::ThetaMatrix mass_, stiffness_;
  eigen::ThetaMatrix keep_, follow_;     // v_middle = keep (v + h c / 2 w') + follow (w_middle - x)
  eigen::ThetaMatrix by_torque_rad_Nm_;  // K^-1
  CableMatrix pull_N_rad_;
};

}  // namespace liana::simulation
