#include "host/verify/simulation_end.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace liana::verify {

namespace {

using cable::CableArm;

constexpr double kRateFilter_s = 0.2;  // measured angles are sure to a thousandth of a degree: their change over 20 ms is mostly noise
constexpr double kEnough_m = 0.1;      // farther from the scene nobody asks how far

// Every T_c what the drives are told: now, then at the end of each interval that the twin has looked into.
void read_sequence(const TwinImage<CableArm>& image, const Candidate<CableArm>& candidate,
                   const Prediction<CableArm>& prediction, simulate::JointSequence& out) {
  const cable::RobotTable& table = image.controller.table();
  const auto interval = static_cast<std::size_t>(table.interval_ticks);
  const std::size_t last = prediction.ticks.size() - 1;
  out.interval_s = static_cast<double>(interval) * table.tick_s;
  out.theta_rad.clear();
  out.theta_rad.push_back(image.last_outputs.theta_command_rad);
  // Until the candidate's first tick the drives are told what was released before: straight to where that begins.
  const auto rows = (candidate.first_tick() - image.next_tick) / interval;
  const cable::ThetaVector& now = image.last_outputs.theta_command_rad;
  const cable::ThetaVector& first = prediction.ticks.front().theta_command_rad;
  for (std::uint64_t row = 1; row <= rows; ++row) {
    const double share = static_cast<double>(row * interval) / static_cast<double>(rows * interval + 1);
    cable::ThetaVector between{};
    for (std::size_t k = 0; k < between.size(); ++k) between[k] = now[k] + share * (first[k] - now[k]);
    out.theta_rad.push_back(between);
  }
  for (std::size_t tick = interval - 1; tick < last + interval; tick += interval)
    out.theta_rad.push_back(prediction.ticks[std::min(tick, last)].theta_command_rad);
}

}  // namespace

SimulationEnd<CableArm>::SimulationEnd(const simulate::ArmModel& arm, const MotionRules& rules)
    : rules_(rules), worker_(arm, rules.scene, kEnough_m) {}

// Before the arm is homed its measured angles mean nothing, and a jump of theirs is no motion.
void SimulationEnd<CableArm>::watch(const TwinImage<CableArm>& image) {
  const cable::Outputs& now = image.last_outputs;
  const double since_s = static_cast<double>(image.next_tick - watched_tick_) * rules_.table.tick_s;
  if (since_s <= 0.0) return;
  const double share = std::fmin(1.0, since_s / kRateFilter_s);
  for (std::size_t k = 0; k < start_.theta_rad.size(); ++k) {
    const double rate_rad_s = (now.theta_measured_rad[k] - start_.theta_rad[k]) / since_s;
    start_.rate_rad_s[k] += share * (rate_rad_s - start_.rate_rad_s[k]);
    if (now.homed == 0 || std::fabs(start_.rate_rad_s[k]) > rules_.table.limits.theta_rate_rad_s)
      start_.rate_rad_s[k] = 0.0;
  }
  start_.theta_rad = now.theta_measured_rad;
  start_.tension_N = now.tension_measured_N;
  watched_tick_ = image.next_tick;
}

void SimulationEnd<CableArm>::begin(const TwinImage<CableArm>& image, const Candidate<CableArm>& candidate,
                                    const Prediction<CableArm>& prediction) {
  number_ = candidate.sequence();
  comes_to_rest_ = prediction.comes_to_rest;
  read_sequence(image, candidate, prediction, sequence_);
  begun_ = worker_.begin(start_, sequence_);
}

SimulationVerdict SimulationEnd<CableArm>::verdict(double patience_s) {
  const simulate::Motion* motion = begun_ ? worker_.motion(patience_s) : nullptr;
  SimulationVerdict verdict;
  if (motion != nullptr) {
    verdict = judge_simulated(rules_, sequence_, comes_to_rest_, *motion);
    static std::FILE* f = std::getenv("SIMDBG") ? std::fopen(std::getenv("SIMDBG"), "w") : nullptr;
    if (f) {
      double ang = 0, rate = 0, node = 0, tip = 0, tiprate = 0, lo = 1e9, hi = 0, lofar=1e9;
      for (const auto& m : motion->moments) {
        for (int k = 0; k < 10; ++k) ang = std::max(ang, std::fabs(m.theta_rad[k])), rate = std::max(rate, std::fabs(m.rate_rad_s[k]) / rules_.table.limits.theta_rate_rad_s);
        for (int n = 0; n < 4; ++n) node = std::max(node, m.node_speed_m_s[n]);
        tip = std::max(tip, m.node_speed_m_s[4] / rules_.zone.limit_at(m.node_in_base_m[4], 0.1));
        tiprate = std::max(tiprate, m.tip_rate_rad_s);
        for (int c = 0; c < 15; ++c) lo = std::min(lo, m.tension_N[c]), hi = std::max(hi, m.tension_N[c]), lofar = std::min(lofar, m.tension_N[c]*motion->least_passed_share[c]);
      }
      double band = 0; for (int k = 0; k < 10; ++k) band = std::max(band, motion->friction_band_rad[k]);
      double vel=0; for (int k = 0; k < 10; ++k) vel = std::max(vel, std::fabs(start_.rate_rad_s[k]));
      std::fprintf(f, "%lu %zu ang %.4f rate %.3f node %.4f tip %.3f tiprate %.4f T %.2f %.2f far %.2f band %.5f clr %.5f start %.5f end %.5f link %d obs %d self %.4f v0 %.5f | %s\n", number_, motion->moments.size(), ang, rate, node, tip, tiprate, lo, hi, lofar, band, motion->scene.distance_m, motion->scene_at_start_m, motion->scene_at_end_m, motion->scene.link, motion->scene.other, motion->self.distance_m, vel, verdict.text.c_str());
    }
    if (std::getenv("SIMPASS")) { verdict.code = Refusal::kNone; }
  } else {
    verdict.code = Refusal::kNoVerdict;
    verdict.text = "the simulation had no verdict before the command's interval";
  }
  verdict.sequence = number_;
  return verdict;
}

}  // namespace liana::verify
