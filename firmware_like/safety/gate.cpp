#include "firmware_like/safety/gate.hpp"

#include "firmware_like/math/convert.hpp"

namespace liana {
namespace {

using namespace gate_compare;

constexpr std::array<const char*, 12> kCheckNames{
    "passed",
    "target_not_finite",
    "target_out_of_range",
    "step_too_large",
    "torque_not_finite",
    "torque_out_of_range",
    "drive_not_enabled",
    "mode_not_allowed",
    "rate_not_finite",
    "rate_out_of_range",
    "rate_step_too_large",
    "torque_step_too_large",
};
static_assert(static_cast<std::size_t>(GateCheck::kTorqueStepTooLarge) + 1 == kCheckNames.size(),
              "every check has a name");

// A drive holds its previous target only while it has torque and was told to; any other has no target worth holding.
std::int32_t safe_target(DriveState state, const DriveCommand& previous, const DriveFeedback& feedback) noexcept {
  const bool holds = has_torque(state) && previous.controlword != kDisableVoltage;
  return holds ? previous.target_counts : feedback.position_counts;
}

// A target that changes no faster than the drive may turn, or that lets go.
bool is_step_allowed(const DriveLimits& limits, bool lets_go, std::int32_t previous, std::int32_t next,
                     std::int32_t position) noexcept {
  if (!is_step_too_large(previous, next, limits.step_counts)) return true;
  if (!lets_go || limits.let_go_counts == 0) return false;
  return is_let_go(previous, next, limits.let_go_counts) || is_taken_back(previous, next, position, limits.step_counts);
}

// cst: torque and rate are what moves the joint; its range is kept by where it stands. `judged` gets both, rounded.
GateCheck judge_torque(const DriveLimits& limits, const DriveProposal& proposal, const DriveCommand& previous,
                       std::int32_t position_counts, DriveCommand& judged) noexcept {
  const double rate = proposal.rate_counts_s, torque = proposal.torque_permille;
  if (is_not_finite(rate)) return GateCheck::kRateNotFinite;
  if (is_outside(rate, -limits.max_rate_counts_s, limits.max_rate_counts_s)) return GateCheck::kRateOutOfRange;
  if ((position_counts > limits.max_counts && rate > 0.0) || (position_counts < limits.min_counts && rate < 0.0)) {
    return GateCheck::kRateOutOfRange;
  }
  const double rate_step = rate - previous.rate_counts_s, torque_step = torque - previous.torque_permille;
  if (is_outside(rate_step, -limits.rate_step_counts_s, limits.rate_step_counts_s)) return GateCheck::kRateStepTooLarge;
  if (is_outside(torque_step, -limits.torque_step_permille, limits.torque_step_permille)) {
    return GateCheck::kTorqueStepTooLarge;
  }
  judged.rate_counts_s = to_counts(rate).value;
  judged.torque_permille = narrow<std::int16_t>(to_counts(torque).value);
  return GateCheck::kPassed;
}

// First check that the proposal for one drive fails; `judged` is what it is told when it passes.
GateCheck judge(const DriveLimits& limits, const DriveProposal& proposal, const DriveCommand& previous,
                DriveState state, std::int32_t position_counts, DriveCommand& judged) noexcept {
  if (state != DriveState::kOperationEnabled) return GateCheck::kDriveNotEnabled;
  if (proposal.mode != limits.mode) return GateCheck::kModeNotAllowed;
  if (is_not_finite(proposal.target_counts)) return GateCheck::kTargetNotFinite;
  if (is_outside(proposal.target_counts, limits.min_counts, limits.max_counts)) return GateCheck::kTargetOutOfRange;
  const Counts target = to_counts(proposal.target_counts);
  if (target.status != CountStatus::kExact) return GateCheck::kTargetOutOfRange;
  if (!is_step_allowed(limits, proposal.lets_go, previous.target_counts, target.value, position_counts)) {
    return GateCheck::kStepTooLarge;
  }
  if (is_not_finite(proposal.torque_permille)) return GateCheck::kTorqueNotFinite;
  if (is_outside(proposal.torque_permille, limits.min_permille, limits.max_permille)) {
    return GateCheck::kTorqueOutOfRange;
  }
  judged.target_counts = target.value;
  if (limits.mode != DriveMode::kCyclicTorque) return GateCheck::kPassed;
  return judge_torque(limits, proposal, previous, position_counts, judged);
}

}  // namespace

GateResult gate(const GateLimits& limits, DriveGoal goal, bool live_targets, const DriveProposals& proposal,
                const DriveCommands& previous, const DriveFeedbacks& feedback) noexcept {
  GateResult result{};
  for (std::int32_t drive = 0; live_targets && drive < limits.drive_count; ++drive) {
    const std::size_t i = as_index(drive);
    const DriveState state = decode(feedback[i].statusword);
    result.command[i].controlword = controlword_for(state, goal, previous[i].controlword);
    result.check =
        judge(limits.drive[i], proposal[i], previous[i], state, feedback[i].position_counts, result.command[i]);
    if (result.check == GateCheck::kPassed) continue;
    result.drive = narrow<std::int16_t>(drive);
    break;
  }
  if (live_targets && result.check == GateCheck::kPassed) return result;
  for (std::int32_t drive = 0; drive < limits.drive_count; ++drive) {
    const std::size_t i = as_index(drive);
    const DriveState state = decode(feedback[i].statusword);
    result.command[i] = {};
    result.command[i].controlword = controlword_for(state, goal, previous[i].controlword);
    result.command[i].target_counts = safe_target(state, previous[i], feedback[i]);
  }
  return result;
}

Fault gate_fault(const GateResult& result, std::uint64_t tick) noexcept {
  if (result.check == GateCheck::kPassed) return {};
  return {FaultNumber::kGateRefused, result.drive, static_cast<std::uint16_t>(result.check), tick};
}

const char* gate_check_name(GateCheck check) noexcept {
  const auto row = static_cast<std::size_t>(check);
  return row < kCheckNames.size() ? kCheckNames[row] : "unknown";
}

}  // namespace liana
