#include "firmware_like/safety/gate.hpp"

#include <cmath>

#include "firmware_like/math/convert.hpp"

namespace liana {
namespace {

using namespace gate_compare;

constexpr std::array<const char*, 7> kCheckNames{
    "passed",
    "payout_not_finite",
    "payout_out_of_range",
    "step_too_large",
    "tension_not_finite",
    "tension_out_of_range",
    "drive_not_enabled",
};
static_assert(static_cast<std::size_t>(GateCheck::kDriveNotEnabled) + 1 == kCheckNames.size(), "every check has a name");

// Most that bending can change the path of a cable of segment `segment` (0-based): no hole turns about a joint with a larger arm than its
// distance from the joint centre, and a joint turns about two axes.
double most_bend_m(const RobotTable& table, std::int32_t segment) noexcept {
  const double arm_m = std::sqrt(table.hole_radius_m * table.hole_radius_m + table.face_offset_m * table.face_offset_m);
  double turn_rad = 0.0;
  for (std::int32_t m = 0; m <= segment; ++m) {
    const SegmentTable& part = table.segment[as_index(m)];
    turn_rad += 2.0 * static_cast<double>(part.modules) * part.theta_limit_rad;
  }
  return arm_m * turn_rad;
}

// A drive holds its previous target only while it has torque and was told to; any other has no target worth holding.
std::int32_t safe_target(DriveState state, const DriveCommand& previous, const DriveFeedback& feedback) noexcept {
  const bool holds = has_torque(state) && previous.controlword != kDisableVoltage;
  return holds ? previous.target_counts : feedback.position_counts;
}

// First check that the proposal for one drive fails; `target_counts` is its target when it passes.
GateCheck judge(const RobotTable& table, const GateLimits& limits, const GateProposal& proposal, const DriveCommand& previous,
                DriveState state, std::size_t i, std::int32_t& target_counts) noexcept {
  const double payout_m = proposal.payout_m[i];
  const double tension_N = proposal.tension_plan_N[i];
  if (state != DriveState::kOperationEnabled) return GateCheck::kDriveNotEnabled;
  if (is_not_finite(payout_m)) return GateCheck::kPayoutNotFinite;
  if (is_outside(payout_m, limits.least_payout_m[i], limits.most_payout_m[i])) return GateCheck::kPayoutOutOfRange;
  const Counts target = counts_at_payout(table.drive[i], limits.zero_payout_m[i], payout_m);
  if (target.status != CountStatus::kExact) return GateCheck::kPayoutOutOfRange;
  if (is_step_too_large(previous.target_counts, target.value, limits.step_counts[i])) return GateCheck::kStepTooLarge;
  if (is_not_finite(tension_N)) return GateCheck::kTensionNotFinite;
  if (is_outside(tension_N, 0.0, limits.tension_ceiling_N)) return GateCheck::kTensionOutOfRange;
  target_counts = target.value;
  return GateCheck::kPassed;
}

}  // namespace

GateLimits make_gate_limits(const RobotTable& table, const CableVector& zero_payout_m) noexcept {
  GateLimits limits{};
  limits.drive_count = table.cable_count();
  limits.zero_payout_m = zero_payout_m;
  limits.tension_ceiling_N = table.tension.ceiling_free_N;
  const double step_m = table.limits.cable_speed_m_s * table.tick_s * kGateSpeedMargin;
  std::int32_t cable = 0;
  for (std::int32_t segment = 0; segment < table.segment_count; ++segment) {
    const double bend_m = most_bend_m(table, segment);
    for (std::int32_t c = 0; c < table.segment[as_index(segment)].cables; ++c, ++cable) {
      const std::size_t i = as_index(cable);
      const double elongation_m = (zero_payout_m[i] + bend_m) * table.tension.hard_limit_N / table.cable_EA_N;
      limits.least_payout_m[i] = zero_payout_m[i] - bend_m - elongation_m;
      limits.most_payout_m[i] = zero_payout_m[i] + bend_m + elongation_m;
      limits.step_counts[i] = static_cast<std::int64_t>(to_counts(step_m / table.drive[i].metres_per_count).value) + kGateRoundingCounts;
    }
  }
  return limits;
}

GateResult gate(const RobotTable& table, const GateLimits& limits, const GateProposal& proposal,
                const std::array<DriveCommand, kMaxCables>& previous, const std::array<DriveFeedback, kMaxCables>& feedback) noexcept {
  GateResult result{};
  std::array<std::int32_t, kMaxCables> judged_counts{};
  for (std::int32_t drive = 0; drive < limits.drive_count; ++drive) {
    const std::size_t i = as_index(drive);
    const DriveState state = decode(feedback[i].statusword);
    result.command[i].controlword = controlword_for(state, proposal.goal, previous[i].controlword);
    result.command[i].target_counts = safe_target(state, previous[i], feedback[i]);
    if (!proposal.live_targets || result.check != GateCheck::kPassed) continue;
    result.check = judge(table, limits, proposal, previous[i], state, i, judged_counts[i]);
    if (result.check != GateCheck::kPassed) result.drive = narrow<std::int16_t>(drive);
  }
  if (!proposal.live_targets || result.check != GateCheck::kPassed) return result;
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
