// The arm for machines that are too slow for the full physics: no inertia, no contact, no friction in the cables.
#pragma once

#include "hil/arm/arm.hpp"
#include "hil/arm/base_drives.hpp"
#include "hil/arm/cable_geometry.hpp"
#include "hil/arm/true_parameters.hpp"

namespace liana::bench {

// The angles follow the drums by c dtheta/dt = -J^T t, c the viscous friction of the joints: they creep to where the
// cables balance, which is where the full physics without friction comes to rest. Tensions are elongation times
// stiffness over the exact cable lengths. One implicit Gauss-Newton step per call, about 20,000 instructions with five
// segments, for slots as long as the bus's. Slide and roll of a base stand where their drives stand, without force.
class KinematicArm final : public Arm {
 public:
  // As ArmPhysics: at rest at `start_rad`, around 30 N. Throws std::runtime_error for no balance there, or when `truth`
  // has friction.
  KinematicArm(const RobotConfig& robot, const TrueParameters& truth, const Theta& start_rad);

  CableValues payouts_m() const override { return payout_; }
  void begin_slot(double /*duration_s*/) override {}
  void step(double step_s, const CableValues& payout_m) override;
  double longest_step_s() const override { return 0.02; }

  const Theta& theta_rad() const override { return theta_; }
  const Theta& rate_rad_s() const override { return rate_; }
  double motor_tension_N(std::size_t drive) const override {
    return drive < base_.count() ? 0.0 : tension_N_[drive - base_.count()];
  }
  Pose tip() const override { return tip_; }
  void remove_rod() override {}
  void set_pushes(const std::vector<Push>&) override {}  // main.cpp refuses them
  void set_jammed(std::size_t, bool) override {}         // the plant refuses it
  Clearance clearance() const override;
  LoadRecord take_record() override;
  ArmCounts counts() const override { return {}; }

 private:
  double payout_m(std::size_t cable) const { return payout_[base_.count() + cable]; }
  void follow_base(double step_s);
  void stretch();
  void note_extremes();
  void pull(Theta& torque, ThetaMatrix& stiffness) const;

  RobotConfig robot_;
  std::size_t thetas_;
  double EA_N_;
  CablePaths paths_;
  BaseDrives base_;
  CableValues payout_{};     // per drive
  CableValues tension_N_{};  // per cable
  Theta theta_{};
  Theta rate_{};
  Pose tip_;
  LoadRecord record_;
};

// Tip of the arm with these angles, base frame: every joint turns pitch first in odd modules and yaw first in even
// ones.
Pose tip_of(const RobotConfig& robot, const Theta& theta_rad);

}  // namespace liana::bench
