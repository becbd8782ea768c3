#include "host/control/verification/model_watch.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/tension.hpp"
#include "host/control/verification/judge.hpp"

namespace liana::verification {

namespace {

using Index = std::size_t;

cable::SegmentVector wraps_rad(const cable::RobotParams& table, const cable::Outputs& at) {
  return cable::cable_wraps(table, cable::arm_trig(table, at.theta_command_rad));
}

double sum_of(const cable::SegmentVector& wrap_rad) {
  double sum_rad = 0.0;
  for (const double each_rad : wrap_rad) sum_rad += each_rad;
  return sum_rad;
}

// Tensions: friction may hold a cable anywhere between its plan less and its plan more what its whole bend takes.
void judge_tensions(const cable::RobotParams& table, const cable::Outputs& now, const cable::SegmentVector& wrap_rad,
                    Judge& judge) {
  const double near_floor_N = table.tension.floor_motor_N + 2.0 * cable::kTautBelow_N * table.tension.scale();
  const double mu = std::fmax(now.friction.planned_mu, now.friction.mu);
  Index c = 0;
  double bend_rad = 0.0;
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) {
    bend_rad += wrap_rad[j];
    const double share = std::clamp(std::exp(mu * bend_rad) - 1.0, kModelTensionShare, kModelBendShare);
    for (int i = 0; i < table.segment[j].cables; ++i, ++c) {
      // Its plan has what it is wound in by, which friction may hold; slack is judged by simulation and monitors.
      if (now.tension_measured_N[c] < near_floor_N) continue;
      judge.check(Refusal::kModel, "the model does not hold: measured less planned tension of cable", kNewtons,
                  static_cast<int>(c), now.tension_measured_N[c] - now.tension_plan_N[c],
                  kModelTension_N + share * now.tension_plan_N[c]);
    }
  }
}

}  // namespace

void judge_model(const cable::RobotParams& table, const cable::Outputs& now, const cable::Outputs& then,
                 bool leads_back, ExecutionVerdict& verdict) {
  const bool concerns = now.state == OperatingState::kEnabled && now.faults.count == 0 && !leads_back;
  if (!verdict.passed() || !concerns) return;
  Judge judge(verdict, &table);
  for (Index i = 0; i < static_cast<Index>(table.theta_count()); ++i) {
    judge.check(Refusal::kModel, "the model does not hold: measured less commanded theta", kDegrees,
                static_cast<int>(i), now.theta_measured_rad[i] - now.theta_command_rad[i], kModelAngle_rad);
  }
  const cable::SegmentVector wrap_rad = wraps_rad(table, now);
  const bool straightens = sum_of(wraps_rad(table, then)) < sum_of(wrap_rad);
  if (!straightens) judge_tensions(table, now, wrap_rad, judge);
}

}  // namespace liana::verification
