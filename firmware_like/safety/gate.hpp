// The gate: last, pure step of a tick. Nothing reaches a drive that it has not judged; a proposal that fails becomes the safe command.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/controller_io.hpp"
#include "firmware_like/drive/cia402.hpp"

namespace liana {

// Over the cable speed limit per tick: room for elongation that the pretension ramp and the tension plan add to the motion, and for the
// servo's mode damping. Half a count of rounding at either end comes on top.
constexpr double kGateSpeedMargin = 1.25;
constexpr std::int64_t kGateRoundingCounts = 1;

// Which check refused; the numbers are the detail of kGateRefused and never change meaning.
enum class GateCheck : std::uint8_t {
  kPassed = 0,
  kPayoutNotFinite = 1,
  kPayoutOutOfRange = 2,  // a length the arm cannot have, or counts beyond 32 bits
  kStepTooLarge = 3,      // target changes faster than the cable speed limit with margin
  kTensionNotFinite = 4,
  kTensionOutOfRange = 5,  // planned tension negative or over the ceiling
  kDriveNotEnabled = 6,    // motion was proposed while this drive is not in Operation enabled
};

// Limits derived once from the robot table.
struct GateLimits {
  std::int32_t drive_count = 0;
  CableVector zero_payout_m{};  // length at zero_counts
  CableVector least_payout_m{};
  CableVector most_payout_m{};
  std::array<std::int64_t, kMaxCables> step_counts{};  // largest target change in one tick
  double tension_ceiling_N = 0.0;
};

// Limits of a checked table. `zero_payout_m` per cable: path at the zero pose plus lead. The range is what bending every joint fully can
// add or take, plus the elongation at the hard limit.
GateLimits make_gate_limits(const RobotTable& table, const CableVector& zero_payout_m) noexcept;

// What the motion stages propose for one tick.
struct GateProposal {
  DriveGoal goal = DriveGoal::kDisabled;  // from the supervisor's orders
  bool live_targets = false;              // from the supervisor's orders; false: payouts are not looked at
  CableVector payout_m{};                 // unstretched length
  CableVector tension_plan_N{};           // at the motor
};

// What goes to the drives, and why it is not the proposal.
struct GateResult {
  std::array<DriveCommand, kMaxCables> command{};
  GateCheck check = GateCheck::kPassed;
  std::int16_t drive = -1;  // first drive that failed, 0-based
};

// Judges a proposal against what was sent in the previous tick and what the drives report. All drives pass, or none: after a refusal
// every drive gets its safe target. The safe target, also sent while targets are not live, is the previous one for a drive that has
// torque and was told to have it, and the actual position for every other drive.
GateResult gate(const RobotTable& table, const GateLimits& limits, const GateProposal& proposal,
                const std::array<DriveCommand, kMaxCables>& previous, const std::array<DriveFeedback, kMaxCables>& feedback) noexcept;

// Fault of a refusal: kGateRefused with the drive and the check; number kNone when the gate passed the proposal.
Fault gate_fault(const GateResult& result, std::uint64_t tick) noexcept;

// Name of a check as logs print it, e.g. "step_too_large"; never null.
const char* gate_check_name(GateCheck check) noexcept;

// The comparisons, alone so that tests can tell wrong variants from them.
namespace gate_compare {

// True when a value lies outside [low, high] or is not a number.
constexpr bool is_outside(double value, double low, double high) noexcept { return !(value >= low && value <= high); }

// True for infinities and NaN.
constexpr bool is_not_finite(double value) noexcept { return !(value - value == 0.0); }

// True when two targets are more than `limit` counts apart.
constexpr bool is_step_too_large(std::int32_t previous, std::int32_t next, std::int64_t limit) noexcept {
  const std::int64_t step = static_cast<std::int64_t>(next) - previous;
  return step > limit || step < -limit;
}

}  // namespace gate_compare

}  // namespace liana
