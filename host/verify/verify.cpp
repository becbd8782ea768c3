#include "host/verify/verify.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace liana {

namespace {

constexpr double kRounding = 1.0 + 1e-6;  // limits that the limiter reaches exactly
// The filter bounds the target; the tip itself may lead it a little while the servo IK catches up.
constexpr double kTipSpeedMargin = 1.05;

// How far the servo IK may fall behind: far more than rounding and limiting leave (micrometres), far less than anyone
// would see. A tip target beyond the arm's reach grows past it within a few intervals, before the arm has stretched out
// and folded back.
constexpr double kIkDistance_m = 0.005;
constexpr double kIkAngle_rad = 0.01;

// Compares values with limits; remembers the first failure and the tightest pass.
class Judge {
 public:
  explicit Judge(Verdict& verdict) : verdict_(verdict) {}

  void check(Refusal code, const char* what, int index, double value, double limit) {
    if (!std::isfinite(value)) return refuse(Refusal::kNotFinite, describe(what, index) + " is not a finite number");
    const double share = std::fabs(value) / limit;
    if (share > tightest_) {
      tightest_ = share;
      char text[32];
      std::snprintf(text, sizeof text, "%.3f", share);
      verdict_.margin = describe(what, index) + ": " + text + " of the limit";
    }
    if (std::fabs(value) > limit * kRounding)
      refuse(code, describe(what, index) + " = " + number(value) + ", allowed " + number(limit));
  }
  void require(bool good, Refusal code, const std::string& text) {
    if (!good) refuse(code, text);
  }

 private:
  static std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
  }
  static std::string describe(const char* what, int index) {
    return index < 0 ? what : what + std::string(" ") + std::to_string(index + 1);
  }
  void refuse(Refusal code, const std::string& text) {
    if (!verdict_.passed()) return;
    verdict_.code = code;
    verdict_.text = text;
  }

  Verdict& verdict_;
  double tightest_ = 0.0;
};

void judge_tension(const cable::RobotTable& table, const cable::Outputs& outputs, Judge& judge) {
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.cable_count()); ++i) {
    const double tension_N = outputs.tension_plan_N[i];
    judge.check(Refusal::kTension, "planned tension [N] of cable", static_cast<int>(i), tension_N,
                table.tension.ceiling_free_N);
    judge.require(tension_N * kRounding >= table.tension.floor_motor_N, Refusal::kTension,
                  "planned tension of cable " + std::to_string(i + 1) + " is under the floor");
  }
}

void judge_cables(const cable::RobotTable& table, const cable::Outputs& before, const cable::Outputs& after,
                  Judge& judge) {
  const double way_m = kTargetSpeedMargin * table.limits.cable_speed_m_s * table.tick_s;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.cable_count()); ++i) {
    judge.check(Refusal::kCableSpeed, "travel per tick [m] of cable", static_cast<int>(i),
                after.payout_command_m[i] - before.payout_command_m[i], way_m);
  }
}

}  // namespace

std::size_t max_stop_ticks(const cable::RobotTable& table) {
  return static_cast<std::size_t>(kMaxStop_s / table.tick_s);
}

ExecutionVerdict judge_execution(const cable::RobotTable& table, const Candidate& candidate,
                                 const Prediction& prediction) {
  ExecutionVerdict verdict;
  verdict.sequence = candidate.sequence();
  Judge judge(verdict);
  for (std::size_t i = 0; i < prediction.ticks.size(); ++i) {
    const cable::Outputs& outputs = prediction.ticks[i];
    const auto faults = static_cast<std::uint64_t>(outputs.faults.count) + outputs.faults.dropped;
    const bool accepted = i >= prediction.command_ticks || outputs.active_sequence == candidate.sequence();
    judge.require(faults <= prediction.faults_before, Refusal::kTwinFault, "the controller would latch a fault");
    judge.require((outputs.limits & kLimitGate) == 0, Refusal::kGate, "the gate would refuse an output");
    judge.require(accepted, Refusal::kNotAccepted, "the controller would not take the command");
    judge_tension(table, outputs, judge);
    if (i > 0) judge_cables(table, prediction.ticks[i - 1], outputs, judge);
    if (!verdict.passed()) return verdict;
  }
  return verdict;
}

void judge_time(const Candidate& candidate, std::uint64_t ticks_done, ExecutionVerdict& verdict) {
  if (!verdict.passed() || ticks_done < candidate.first_tick()) return;
  verdict.code = Refusal::kTooSlow;
  verdict.text = "verification took longer than the command interval";
}

SimulationVerdict judge_motion(const cable::RobotTable& table, const Candidate& candidate, const Prediction& prediction,
                               const SpeedZone& zone) {
  SimulationVerdict verdict;
  verdict.sequence = candidate.sequence();
  Judge judge(verdict);
  for (const cable::Outputs& outputs : prediction.ticks) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i) {
      judge.check(Refusal::kJointAngle, "theta [rad]", static_cast<int>(i), outputs.theta_command_rad[i],
                  table.segment[i / 2].theta_limit_rad);
      judge.check(Refusal::kJointRate, "rate of theta [rad/s]", static_cast<int>(i), outputs.theta_rate_rad_s[i],
                  table.limits.theta_rate_rad_s);
    }
    const double speed_m_s = zone.limit_at(outputs.tip_command.position_m, table.limits.tip_speed_m_s);
    judge.check(Refusal::kTipSpeed, "tip speed [m/s]", -1, outputs.tip_speed_m_s, kTipSpeedMargin * speed_m_s);
    judge.check(Refusal::kTipSpeed, "tip turn rate [rad/s]", -1, outputs.tip_rate_rad_s,
                kTipSpeedMargin * table.limits.tip_rate_rad_s);
    judge.check(Refusal::kUnreachable, "distance of the tip from its target [m]", -1, outputs.ik_position_error_m,
                kIkDistance_m);
    judge.check(Refusal::kUnreachable, "angle of the tip from its target [rad]", -1, outputs.ik_attitude_error_rad,
                kIkAngle_rad);
    if (!verdict.passed()) return verdict;
  }
  judge.require(prediction.comes_to_rest, Refusal::kNoRest,
                "the arm would not come to rest within 3 s after the command");
  return verdict;
}

}  // namespace liana
