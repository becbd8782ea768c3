#include "host/control/verification/simulation_verifier.hpp"

namespace liana::verification {

using cable::CableArm;

SimulationVerifier<CableArm>::SimulationVerifier(const simulation::ArmModel& arm, const MotionRules& rules)
    : rules_(rules), worker_(arm, rules.scene, kEnough_m), observer_(arm) {}

// Before the arm is homed its angles mean nothing.
void SimulationVerifier<CableArm>::watch(const TwinSnapshot<CableArm>& image) {
  const cable::Outputs& now = image.last_outputs;
  const double since_s = static_cast<double>(image.next_tick - watched_tick_) * rules_.table.tick_s;
  if (since_s <= 0.0) return;
  if (now.state != OperatingState::kEnabled) too_near_.disabled();
  if (now.homed == 0) {
    too_near_.forget();
    observer_.forget();
  }
  observer_.watch(now.theta_measured_rad, now.tension_measured_N, told_now(rules_.table, now), since_s);
  watched_tick_ = image.next_tick;
  stop_.solved = false;
  stop_swings_ = StopSwings::kUnknown;
}

void SimulationVerifier<CableArm>::believe(const cable::ThetaVector& theta_off_rad, const Pose& drawing_in_base,
                                           double prediction_m) {
  theta_off_rad_ = theta_off_rad;
  rules_.drawing_in_base = drawing_in_base;
  rules_.scene.margins.prediction_m = prediction_m;
}

void SimulationVerifier<CableArm>::begin(const TwinSnapshot<CableArm>& image, const Candidate<CableArm>& candidate,
                                         const Prediction<CableArm>& prediction, bool retracts) {
  number_ = candidate.sequence();
  trial_ = candidate.trial();
  comes_to_rest_ = prediction.comes_to_rest;
  too_near_.retracts = retracts;
  begun_ = simulates(image, candidate.first_tick(), prediction);
}

bool SimulationVerifier<CableArm>::simulates(const TwinSnapshot<CableArm>& image, std::uint64_t first_tick,
                                             const Prediction<CableArm>& prediction) {
  read_sequence(image, first_tick, prediction, sequence_);
  simulation::StartState start = observer_.now();
  start.drawing_in_base = rules_.drawing_in_base;
  for (std::size_t k = 0; k < start.theta_rad.size(); ++k) start.theta_rad[k] += theta_off_rad_[k];
  return worker_.begin(start, sequence_);
}

StopSwings SimulationVerifier<CableArm>::look_at_stop(const TwinSnapshot<CableArm>& image, std::uint64_t first_tick,
                                                      const Prediction<CableArm>& stop, double patience_s) {
  if (stop_.solved || !simulates(image, first_tick, stop)) return stop_swings_;
  const simulation::Motion* motion = worker_.motion(patience_s);
  if (motion == nullptr || !motion->solved) return stop_swings_;
  stop_ = *motion;
  TooNear too_near = too_near_;
  const bool passes = judge_simulated(rules_, sequence_, true, stop_, too_near, &stop_).passed();
  return stop_swings_ = passes ? StopSwings::kPasses : StopSwings::kTouches;
}

SimulationVerdict SimulationVerifier<CableArm>::verdict(double patience_s) {
  const simulation::Motion* motion = begun_ ? worker_.motion(patience_s) : nullptr;
  SimulationVerdict verdict;
  if (motion != nullptr) {
    verdict = judge_simulated(rules_, sequence_, comes_to_rest_, *motion, too_near_, &stop_);
  } else {
    verdict.code = Refusal::kNoVerdict;
    verdict.text = "the simulation had no verdict before the command's interval";
  }
  verdict.sequence = number_;
  verdict.trial = trial_;
  return verdict;
}

void SimulationVerifier<serial::SerialArm>::begin(const TwinSnapshot<Arm>& image, const Candidate<Arm>& candidate,
                                                  const Prediction<Arm>& prediction, bool retracts) {
  too_near_.retracts = retracts;
  verdict_ = judge_motion<Arm>(table_, candidate, prediction);
  verdict_.margins = margins_unknown();
  if (!verdict_.passed()) return;
  read_sequence(image, candidate.first_tick(), prediction, sequence_);
  const bool carries = candidate.setpoint().payload_at_tip.mass_kg > 0.0;
  const simulation::SerialMotion& motion = simulation_.run(image.last_outputs.joint_measured_rad, sequence_, carries);
  judge_serial(table_, simulation_, sequence_, motion, too_near_, verdict_);
}

}  // namespace liana::verification
