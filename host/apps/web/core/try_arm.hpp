// An arm that a visitor of a page steers: the controller, both verification ends and a drawn scene, without a process,
// a bus or a real drive. The same inputs give the same bits wherever it is compiled.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "host/control/arbiter/refusal_wait.hpp"
#include "host/control/arbiter/start_ramp.hpp"
#include "host/control/verification/judge_simulated.hpp"
#include "host/control/verification/nominal_drives.hpp"
#include "host/control/verification/told_sequence.hpp"
#include "host/control/virtual_fixtures/guidance.hpp"
#include "host/model/inverse_kinematics/dof_split.hpp"
#include "host/model/simulation/arm_observer.hpp"
#include "host/model/simulation/simulation.hpp"

namespace liana::web {

class TryArm {
 public:
  // Stands at `start_rad`, drives switched off and cables pulled as planned. Robot and scene must have passed the
  // loader.
  TryArm(const config::RobotConfig& robot, const config::SceneConfig& scene, const cable::ThetaVector& start_rad);

  // One command interval. `request` acts in its first tick; `target`: where the tip should go, in the base frame,
  // however far that is; nothing: the arm comes to rest. What verification refuses is not taken, and the arm stops.
  void interval(Request request, const std::optional<Pose>& target);

  // What a page shows of it, as a state of docs/reference/api.md has it; `clearance` is of the drawn arm now.
  std::string state() const;
  // SHA-256 of everything that the controller remembers, its last outputs and how often a command was refused.
  std::string hash() const;

 private:
  using Arm = cable::CableArm;

  cable::Setpoint setpoint_towards(const Pose& target);
  std::int32_t planar_segments(const Pose& tip) const;
  void observe();
  std::optional<cable::Telecommand> verified(const cable::Setpoint& setpoint);
  void tick(Request request, const std::optional<cable::Telecommand>& command);
  double speed_m_s() const;

  config::RobotConfig robot_;
  config::SceneConfig scene_;
  verification::MotionRules rules_;
  inverse_kinematics::SlitMouth mouth_{};
  cable::KeepClearTargets keep_clear_{};
  std::uint64_t interval_ticks_;
  double interval_s_;

  verification::TwinSnapshot<Arm> image_;
  verification::NominalDrives<Arm> drives_;
  verification::IssueStep<Arm> issue_;
  verification::Prediction<Arm> prediction_;
  simulation::Simulation simulation_;
  simulation::ArmObserver observer_;
  simulation::JointSequence sequence_;
  verification::TooNear too_near_;

  virtual_fixtures::Guidance guidance_;
  arbiter::RefusalWait wait_;
  arbiter::GoalRamp ramp_;
  std::int32_t planar_ = 0;
  std::uint64_t released_ = 0, refused_ = 0;
  verification::Refusal code_ = verification::Refusal::kNone;  // of the last command that was looked at
  std::string text_;
  double claim_m_ = 0.0;  // what its motion and stop leave of the clearance
};

}  // namespace liana::web
