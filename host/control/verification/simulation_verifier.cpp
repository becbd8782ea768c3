#include "host/control/verification/simulation_verifier.hpp"

#include <algorithm>
#include <cmath>

namespace liana::verification {

namespace {

using cable::CableArm;

simulation::ToldNow told_now(const cable::RobotParams& table, const cable::Outputs& now) {
  const Eigen::Index thetas = eigen::theta_count(table);
  return {eigen::view(now.theta_command_rad, thetas), eigen::view(now.load_Nm, thetas),
          Eigen::Map<const simulation::CableColumn>(now.tension_plan_N.data(), table.cable_count())};
}

template <class Vector>
Vector between(const Vector& from, const Vector& to, double share) {
  Vector out = from;
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += share * (to[i] - from[i]);
  return out;
}

}  // namespace

template <class Arm>
void read_sequence(const TwinSnapshot<Arm>& image, std::uint64_t first_tick, const Prediction<Arm>& prediction,
                   simulation::ToldRows<arbiter::Joints<Arm>>& out) {
  using Kind = arbiter::ArmTraits<Arm>;
  const auto& table = image.controller.table();
  const auto interval = static_cast<std::size_t>(table.interval_ticks);
  const std::size_t last = prediction.ticks.size() - 1;
  out.interval_s = static_cast<double>(interval) * table.tick_s;
  out.rows_rad.clear();
  const auto& now = Kind::command_rad(image.last_outputs);
  out.rows_rad.push_back(now);
  // Until the candidate's first tick the drives are told what was released before: straight to where that begins.
  const auto rows = (first_tick - image.next_tick) / interval;
  for (std::uint64_t row = 1; row <= rows; ++row) {
    const double share = static_cast<double>(row * interval) / static_cast<double>(rows * interval + 1);
    out.rows_rad.push_back(arbiter::between(now, Kind::command_rad(prediction.ticks.front()), share));
  }
  for (std::size_t tick = interval - 1; tick < last + interval; tick += interval)
    out.rows_rad.push_back(Kind::command_rad(prediction.ticks[std::min(tick, last)]));
}

#define LIANA_READ_SEQUENCE(Arm)                                                                    \
  template void read_sequence<Arm>(const TwinSnapshot<Arm>&, std::uint64_t, const Prediction<Arm>&, \
                                   simulation::ToldRows<arbiter::Joints<Arm>>&)
LIANA_READ_SEQUENCE(cable::CableArm);
LIANA_READ_SEQUENCE(serial::SerialArm);
#undef LIANA_READ_SEQUENCE

void read_sequence(const TwinSnapshot<CableArm>& image, std::uint64_t first_tick,
                   const Prediction<CableArm>& prediction, simulation::JointSequence& out) {
  read_sequence<CableArm>(image, first_tick, prediction, out);
  const auto interval = static_cast<std::size_t>(image.controller.table().interval_ticks);
  const std::size_t last = prediction.ticks.size() - 1;
  const cable::Outputs &now = image.last_outputs, &begins = prediction.ticks.front();
  out.loads_Nm.assign(1, now.load_Nm);
  out.tensions_N.assign(1, now.tension_plan_N);
  const auto rows = (first_tick - image.next_tick) / interval;
  for (std::uint64_t row = 1; row <= rows; ++row) {
    const double share = static_cast<double>(row * interval) / static_cast<double>(rows * interval + 1);
    out.loads_Nm.push_back(between(now.load_Nm, begins.load_Nm, share));
    out.tensions_N.push_back(between(now.tension_plan_N, begins.tension_plan_N, share));
  }
  for (std::size_t tick = interval - 1; tick < last + interval; tick += interval) {
    const cable::Outputs& told = prediction.ticks[std::min(tick, last)];
    out.loads_Nm.push_back(told.load_Nm);
    out.tensions_N.push_back(told.tension_plan_N);
  }
}

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
