#include "host/control/verification/verify.hpp"

#include "host/control/verification/arm_limits.hpp"

namespace liana::verification {

namespace {

// The filter bounds the target; the tip itself may lead it a little while the servo IK catches up.
constexpr double kTipSpeedMargin = 1.05;

// How far the servo IK may fall behind: far more than rounding and limiting leave (micrometres), far less than anyone
// would see. A tip target beyond the arm's reach grows past it within a few intervals, before the arm has stretched out
// and folded back.
constexpr double kIkDistance_m = 0.005;
constexpr double kIkAngle_rad = 0.01;

// The tip against its limits and its target.
template <class Arm>
void judge_tip(const typename Arm::Table& table, const Outputs<Arm>& outputs, const arbiter::SpeedZone& zone,
               Judge& judge) {
  const TipRates most = tip_rates(table);
  const double speed_m_s = zone.limit_at(outputs.tip_command.position_m, most.speed_m_s);
  judge.check(Refusal::kTipSpeed, "tip speed", kMetresPerSecond, -1, outputs.tip_speed_m_s,
              kTipSpeedMargin * speed_m_s);
  judge.check(Refusal::kTipSpeed, "tip turn rate", kDegreesPerSecond, -1, outputs.tip_rate_rad_s,
              kTipSpeedMargin * most.rate_rad_s);
  judge.check(Refusal::kUnreachable, "distance of the tip from its target", kMillimetres, -1,
              outputs.ik_position_error_m, kIkDistance_m);
  judge.check(Refusal::kUnreachable, "angle of the tip from its target", kDegrees, -1, outputs.ik_attitude_error_rad,
              kIkAngle_rad);
}

const cable::RobotParams* cables_of(const cable::RobotParams& table) { return &table; }
const cable::RobotParams* cables_of(const serial::RobotParams& /*table*/) { return nullptr; }

// Which fault would be latched: the newest one of the list, unless the list was full before.
std::string fault_text(const FaultList& faults, const cable::RobotParams* cables) {
  if (faults.count == 0 || faults.dropped > 0) return "the controller would latch one more fault";
  const Fault& newest = faults.fault[static_cast<std::size_t>(faults.count - 1)];
  const std::string text = "the controller would latch fault " + std::to_string(static_cast<int>(newest.number)) + " " +
                           fault_info(newest.number).name;
  if (newest.index < 0) return text;
  if (newest.number == FaultNumber::kBusLost) return text + ", bus " + std::to_string(newest.index + 1);
  const config::DriveNames names = cables == nullptr ? config::DriveNames() : config::DriveNames(*cables);
  return text + ", " + names.drive(static_cast<std::size_t>(newest.index));
}

constexpr const char* kNoRestText = "the arm would not come to rest within 3 s after the command";

}  // namespace

std::size_t max_stop_ticks(double tick_s) { return static_cast<std::size_t>(kMaxStop_s / tick_s); }

template <class Arm>
ExecutionVerdict judge_execution(const typename Arm::Table& table, const Candidate<Arm>& candidate,
                                 const Prediction<Arm>& prediction, const arbiter::SpeedZone& zone) {
  ExecutionVerdict verdict;
  verdict.sequence = candidate.sequence();
  verdict.trial = candidate.trial();
  Judge judge(verdict, cables_of(table));
  for (std::size_t i = 0; i < prediction.ticks.size(); ++i) {
    const Outputs<Arm>& outputs = prediction.ticks[i];
    const auto faults = static_cast<std::uint64_t>(outputs.faults.count) + outputs.faults.dropped;
    const bool accepted = i >= prediction.command_ticks || outputs.active_sequence == candidate.sequence();
    if (faults > prediction.faults_before)
      judge.refuse(Refusal::kTwinFault, fault_text(outputs.faults, cables_of(table)));
    judge.require((outputs.limits & kLimitGate) == 0, Refusal::kGate, "the gate would refuse an output");
    judge.require(accepted, Refusal::kNotAccepted, "the controller would not take the command");
    judge_targets(table, i > 0 ? &prediction.ticks[i - 1] : nullptr, outputs, judge);
    judge_joints(table, prediction.ticks.front(), outputs, judge);
    judge_tip<Arm>(table, outputs, zone, judge);
    if (!verdict.passed()) break;
  }
  if (candidate.setpoint().kind != CommandKind::kRetract)
    judge_hold(table, prediction.ticks.front(), prediction.ticks.back(), judge);
  judge.require(prediction.comes_to_rest, Refusal::kNoRest, kNoRestText);
  judge.conclude();
  return verdict;
}

void judge_time(std::uint64_t first_tick, std::uint64_t ticks_done, ExecutionVerdict& verdict) {
  if (!verdict.passed() || ticks_done < first_tick) return;
  verdict.code = Refusal::kTooSlow;
  verdict.text = "verification took longer than the command interval";
}

template <class Arm>
SimulationVerdict judge_motion(const typename Arm::Table& table, const Candidate<Arm>& candidate,
                               const Prediction<Arm>& prediction, const arbiter::SpeedZone& zone) {
  SimulationVerdict verdict;
  verdict.sequence = candidate.sequence();
  verdict.trial = candidate.trial();
  Judge judge(verdict, cables_of(table));
  for (const Outputs<Arm>& outputs : prediction.ticks) {
    judge_joints(table, prediction.ticks.front(), outputs, judge);
    judge_tip<Arm>(table, outputs, zone, judge);
    if (!verdict.passed()) break;
  }
  judge.require(prediction.comes_to_rest, Refusal::kNoRest, kNoRestText);
  judge.conclude();
  return verdict;
}

#define LIANA_JUDGE_EXECUTION(Arm)                                                                                 \
  template ExecutionVerdict judge_execution<Arm>(const Arm::Table&, const Candidate<Arm>&, const Prediction<Arm>&, \
                                                 const arbiter::SpeedZone&)
LIANA_JUDGE_EXECUTION(cable::CableArm);
LIANA_JUDGE_EXECUTION(serial::SerialArm);
#undef LIANA_JUDGE_EXECUTION

template SimulationVerdict judge_motion<serial::SerialArm>(const serial::RobotParams&,
                                                           const Candidate<serial::SerialArm>&,
                                                           const Prediction<serial::SerialArm>&,
                                                           const arbiter::SpeedZone&);

}  // namespace liana::verification
