// The arm: reduced angles moved by cables and by contact, with or without weight, semi-implicit steps.
#pragma once

#include <algorithm>
#include <vector>

#include "hil/arm/arm.hpp"
#include "hil/arm/base_drives.hpp"
#include "hil/arm/cable_geometry.hpp"
#include "hil/arm/cable_line.hpp"
#include "hil/arm/chain.hpp"
#include "hil/arm/clearance.hpp"
#include "hil/arm/contact_forces.hpp"
#include "hil/arm/true_parameters.hpp"

namespace liana::bench {

class ArmPhysics final : public Arm {
 public:
  // Arm at rest at `start_rad`, tensions balanced around 30 N with none below 15 N, nothing held by friction. Throws
  // std::runtime_error, also of an arm whose cables are too stiff for its links (stable_step.hpp).
  ArmPhysics(const RobotConfig& robot, const SceneConfig& scene, const TrueParameters& truth, const Theta& start_rad);

  CableValues payouts_m() const override;
  // One step of `step_s` (kStep_s, or what this arm's stiffness bears, stable_step.hpp; without contact up to
  // kLongestStep_s) with the drives at `payout_m`.
  void step(double step_s, const CableValues& payout_m) override;
  double longest_step_s() const override { return std::min(stable_step_s_, near_contact_ ? kStep_s : free_step_s_); }
  // Longer steps, at most kLongestStep_s, in runs in which nothing can touch: four times as fast, and nearly the same.
  void set_free_step(double step_s) { free_step_s_ = step_s; }
  static constexpr double kStep_s = 0.001, kLongestStep_s = 0.004;
  // Call before a run of steps that together last `duration_s`: decides whether anything can touch in them.
  void begin_slot(double duration_s) override;

  const Theta& theta_rad() const override { return theta_; }
  const Theta& rate_rad_s() const override { return rate_; }
  double motor_tension_N(std::size_t drive) const override {
    return drive < base_.count() ? base_.force_N(drive) : lines_[drive - base_.count()].motor_tension_N();
  }
  // Of a cable, counted without the drives of a base.
  double least_tension_N(std::size_t cable) const { return lines_[cable].least_tension_N(); }
  Pose tip() const override { return chain_.tip(); }
  void remove_rod() override;
  void set_pushes(const std::vector<Push>& pushes) override { pushes_ = pushes; }
  void set_jammed(std::size_t drive, bool jammed) override { base_.set_jammed(drive, jammed, theta_); }
  Clearance clearance() const override { return clearance_of(chain_, scene_, robot_.module_radius_m); }
  // Extremes since the last take_record().
  LoadRecord take_record() override;
  // Kinetic plus elastic energy, without that of the arm's weight [J]; for checks.
  double energy_J();

  // For checks: the mechanical state set from outside, joint damping switched off.
  void set_state(const Theta& theta_rad, const Theta& rate_rad_s);
  void set_joint_damping(double viscous_Nms_per_rad) { viscous_ = viscous_Nms_per_rad; }

  Chain& chain() { return chain_; }
  const CablePaths& paths() const { return paths_; }
  ArmCounts counts() const override { return {chain_.warnings(), contact_slots_, max_sweeps_}; }

 private:
  void settle_cables(const CableValues& payout_m);
  void pull(Theta& force) const;
  void stop_at_limits(Theta& force, ThetaMatrix& damping, double step_s) const;
  void touch(double step_s, ContactLoad& load);
  double fastest_joint_m_s() const;
  ThetaMatrix stiffness() const;

  RobotConfig robot_;
  SceneConfig scene_;
  std::size_t thetas_;
  double viscous_;
  Chain chain_;
  CablePaths paths_;
  BaseDrives base_;
  std::vector<CableLine> lines_;
  Theta theta_{};
  Theta rate_{};
  LoadRecord record_;
  std::vector<Push> pushes_;
  bool near_contact_ = true;
  double free_step_s_ = kStep_s;
  double stable_step_s_ = kLongestStep_s;
  std::uint64_t contact_slots_ = 0;
  int max_sweeps_ = 0;
};

}  // namespace liana::bench
