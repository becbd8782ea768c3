#include "firmware_like/safety/gate.hpp"

#include "firmware_like/math/convert.hpp"

namespace liana {
namespace {

using namespace gate_compare;

constexpr std::array<const char*, 8> kCheckNames{
    "passed",
    "target_not_finite",
    "target_out_of_range",
    "step_too_large",
    "torque_not_finite",
    "torque_out_of_range",
    "drive_not_enabled",
    "mode_not_allowed",
};
static_assert(static_cast<std::size_t>(GateCheck::kModeNotAllowed) + 1 == kCheckNames.size(), "every check has a name");

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

// First check that the proposal for one drive fails; `target_counts` is its target when it passes.
GateCheck judge(const DriveLimits& limits, const DriveProposal& proposal, const DriveCommand& previous,
                DriveState state, std::int32_t position_counts, std::int32_t& target_counts) noexcept {
  if (state != DriveState::kOperationEnabled) return GateCheck::kDriveNotEnabled;
  if (proposal.mode != limits.mode) return GateCheck::kModeNotAllowed;
  if (is_not_finite(proposal.target_counts)) return GateCheck::kTargetNotFinite;
  if (is_outside(proposal.target_counts, limits.least_counts, limits.most_counts)) return GateCheck::kTargetOutOfRange;
  const Counts target = to_counts(proposal.target_counts);
  if (target.status != CountStatus::kExact) return GateCheck::kTargetOutOfRange;
  if (!is_step_allowed(limits, proposal.lets_go, previous.target_counts, target.value, position_counts)) {
    return GateCheck::kStepTooLarge;
  }
  if (is_not_finite(proposal.torque_permille)) return GateCheck::kTorqueNotFinite;
  if (is_outside(proposal.torque_permille, limits.least_permille, limits.most_permille)) {
    return GateCheck::kTorqueOutOfRange;
  }
  target_counts = target.value;
  return GateCheck::kPassed;
}

}  // namespace

GateResult gate(const GateLimits& limits, DriveGoal goal, bool live_targets, const DriveProposals& proposal,
                const DriveCommands& previous, const DriveFeedbacks& feedback) noexcept {
  GateResult result{};
  std::array<std::int32_t, kMaxDrives> judged_counts{};
  for (std::int32_t drive = 0; drive < limits.drive_count; ++drive) {
    const std::size_t i = as_index(drive);
    const DriveState state = decode(feedback[i].statusword);
    result.command[i].controlword = controlword_for(state, goal, previous[i].controlword);
    result.command[i].target_counts = safe_target(state, previous[i], feedback[i]);
    if (!live_targets || result.check != GateCheck::kPassed) continue;
    result.check =
        judge(limits.drive[i], proposal[i], previous[i], state, feedback[i].position_counts, judged_counts[i]);
    if (result.check != GateCheck::kPassed) result.drive = narrow<std::int16_t>(drive);
  }
  if (!live_targets || result.check != GateCheck::kPassed) return result;
  for (std::int32_t drive = 0; drive < limits.drive_count; ++drive) {
    result.command[as_index(drive)].target_counts = judged_counts[as_index(drive)];
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
