#include "host/verify/simulation_end.hpp"

#include <algorithm>
#include <cmath>

namespace liana::verify {

namespace {

using cable::CableArm;

constexpr double kRateFilter_s = 0.4;

}  // namespace

template <class Arm>
void read_sequence(const TwinImage<Arm>& image, const Candidate<Arm>& candidate, const Prediction<Arm>& prediction,
                   simulate::ToldRows<arbiter::Joints<Arm>>& out) {
  using Kind = arbiter::ArmKind<Arm>;
  const auto& table = image.controller.table();
  const auto interval = static_cast<std::size_t>(table.interval_ticks);
  const std::size_t last = prediction.ticks.size() - 1;
  out.interval_s = static_cast<double>(interval) * table.tick_s;
  out.rows_rad.clear();
  const auto& now = Kind::command_rad(image.last_outputs);
  out.rows_rad.push_back(now);
  // Until the candidate's first tick the drives are told what was released before: straight to where that begins.
  const auto rows = (candidate.first_tick() - image.next_tick) / interval;
  for (std::uint64_t row = 1; row <= rows; ++row) {
    const double share = static_cast<double>(row * interval) / static_cast<double>(rows * interval + 1);
    out.rows_rad.push_back(arbiter::between(now, Kind::command_rad(prediction.ticks.front()), share));
  }
  for (std::size_t tick = interval - 1; tick < last + interval; tick += interval)
    out.rows_rad.push_back(Kind::command_rad(prediction.ticks[std::min(tick, last)]));
}

#define LIANA_READ_SEQUENCE(Arm)                                                                         \
  template void read_sequence<Arm>(const TwinImage<Arm>&, const Candidate<Arm>&, const Prediction<Arm>&, \
                                   simulate::ToldRows<arbiter::Joints<Arm>>&)
LIANA_READ_SEQUENCE(cable::CableArm);
LIANA_READ_SEQUENCE(serial::SerialArm);
#undef LIANA_READ_SEQUENCE

SimulationEnd<CableArm>::SimulationEnd(const simulate::ArmModel& arm, const MotionRules& rules)
    : rules_(rules), worker_(arm, rules.scene, kEnough_m) {}

// Rates: what the drives are told now, and how much faster or slower the arm was measured to go of late. The measured
// change alone would be noise over 20 ms, and too late over longer times. Before the arm is homed its angles mean
// nothing.
void SimulationEnd<CableArm>::watch(const TwinImage<CableArm>& image) {
  const cable::Outputs& now = image.last_outputs;
  const double since_s = static_cast<double>(image.next_tick - watched_tick_) * rules_.table.tick_s;
  if (since_s <= 0.0) return;
  if (now.state != OperatingState::kEnabled) too_near_.forget();
  const double share = std::fmin(1.0, since_s / kRateFilter_s);
  for (std::size_t k = 0; k < start_.theta_rad.size(); ++k) {
    const double measured_rad = now.theta_measured_rad[k] - start_.theta_rad[k];
    const double told_rad = now.theta_command_rad[k] - told_rad_[k];
    ahead_rad_s_[k] += share * ((measured_rad - told_rad) / since_s - ahead_rad_s_[k]);
    if (now.homed == 0 || std::fabs(ahead_rad_s_[k]) > rules_.table.limits.theta_rate_rad_s) ahead_rad_s_[k] = 0.0;
    start_.rate_rad_s[k] = now.theta_rate_rad_s[k] + ahead_rad_s_[k];
  }
  start_.theta_rad = now.theta_measured_rad;
  start_.tension_N = now.tension_measured_N;
  told_rad_ = now.theta_command_rad;
  watched_tick_ = image.next_tick;
}

void SimulationEnd<CableArm>::believe(const cable::ThetaVector& theta_off_rad, const Pose& drawing_in_base,
                                      double prediction_m) {
  theta_off_rad_ = theta_off_rad;
  start_.drawing_in_base = rules_.drawing_in_base = drawing_in_base;
  rules_.scene.margins.prediction_m = prediction_m;
}

void SimulationEnd<CableArm>::begin(const TwinImage<CableArm>& image, const Candidate<CableArm>& candidate,
                                    const Prediction<CableArm>& prediction) {
  number_ = candidate.sequence();
  comes_to_rest_ = prediction.comes_to_rest;
  read_sequence(image, candidate, prediction, sequence_);
  simulate::StartState start = start_;
  for (std::size_t k = 0; k < start.theta_rad.size(); ++k) start.theta_rad[k] += theta_off_rad_[k];
  begun_ = worker_.begin(start, sequence_);
}

SimulationVerdict SimulationEnd<CableArm>::verdict(double patience_s) {
  const simulate::Motion* motion = begun_ ? worker_.motion(patience_s) : nullptr;
  SimulationVerdict verdict;
  if (motion != nullptr) {
    verdict = judge_simulated(rules_, sequence_, comes_to_rest_, *motion, too_near_);
  } else {
    verdict.code = Refusal::kNoVerdict;
    verdict.text = "the simulation had no verdict before the command's interval";
  }
  verdict.sequence = number_;
  return verdict;
}

void SimulationEnd<serial::SerialArm>::begin(const TwinImage<Arm>& image, const Candidate<Arm>& candidate,
                                             const Prediction<Arm>& prediction) {
  verdict_ = judge_motion<Arm>(table_, candidate, prediction);
  verdict_.margins = margins_unknown();
  if (!verdict_.passed()) return;
  read_sequence(image, candidate, prediction, sequence_);
  const bool carries = candidate.setpoint().payload_at_tip.mass_kg > 0.0;
  const simulate::SerialMotion& motion = simulation_.run(image.last_outputs.joint_measured_rad, sequence_, carries);
  judge_serial(table_, simulation_, sequence_, motion, too_near_, verdict_);
}

}  // namespace liana::verify
