#include "host/control/verification/model_watch.hpp"

#include "host/control/verification/judge.hpp"

namespace liana::verification {

void judge_model(const cable::RobotParams& table, const cable::Outputs& now, ExecutionVerdict& verdict) {
  if (!verdict.passed() || now.state != OperatingState::kEnabled || now.faults.count > 0) return;
  Judge judge(verdict, &table);
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i) {
    judge.check(Refusal::kModel, "the model does not hold: measured less commanded theta", kDegrees,
                static_cast<int>(i), now.theta_measured_rad[i] - now.theta_command_rad[i], kModelAngle_rad);
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
    // Its plan has what it is wound in by, which friction may hold; slack is judged by simulation and monitors.
    if (now.tension_measured_N[c] < table.tension.floor_motor_N) continue;
    judge.check(Refusal::kModel, "the model does not hold: measured less planned tension of cable", kNewtons,
                static_cast<int>(c), now.tension_measured_N[c] - now.tension_plan_N[c],
                kModelTension_N + kModelTensionShare * now.tension_plan_N[c]);
  }
}

}  // namespace liana::verification
