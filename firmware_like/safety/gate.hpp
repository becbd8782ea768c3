// The gate: last, pure step of a tick. Nothing reaches a drive that it has not judged; a proposal that fails becomes
// the safe command. It speaks drive units only (counts, permille of rated torque, modes) and knows nothing of arms.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/safety/faults.hpp"

namespace liana {

// Which check refused; the numbers are the detail of kGateRefused and never change meaning.
enum class GateCheck : std::uint8_t {
  kPassed = 0,
  kTargetNotFinite = 1,
  kTargetOutOfRange = 2,  // a position the drive must never have, or counts beyond 32 bits
  kStepTooLarge = 3,      // the target changes faster than the drive may turn
  kTorqueNotFinite = 4,
  kTorqueOutOfRange = 5,
  kDriveNotEnabled = 6,  // motion was proposed while this drive is not in Operation enabled
  kModeNotAllowed = 7,   // a mode of operation that the drive was not configured for
  kRateNotFinite = 8,
  kRateOutOfRange = 9,  // cst: faster than the drive may turn, or out of its range where it stands
  kRateStepTooLarge = 10,
  kTorqueStepTooLarge = 11,
};

// What one drive may be told.
struct DriveLimits {
  DriveMode mode = DriveMode::kCyclicPosition;
  double min_counts = 0.0;
  double max_counts = 0.0;
  std::int64_t step_counts = 0;  // largest target change in one tick
  double min_permille = 0.0;
  double max_permille = 0.0;
  // cst: largest rate, and largest changes of rate and torque in one tick.
  double max_rate_counts_s = 0.0;
  double rate_step_counts_s = 0.0;
  double torque_step_permille = 0.0;
  // How far a target may jump for a proposal that lets go, with the sign of the way that gives in; 0: never.
  std::int64_t let_go_counts = 0;
};

// Limits of all drives, derived once from the robot table.
struct GateLimits {
  std::int32_t drive_count = 0;
  std::array<DriveLimits, kMaxDrives> drive{};
};

// What goes to the drives, and why it is not the proposal.
struct GateResult {
  DriveCommands command{};
  GateCheck check = GateCheck::kPassed;
  std::int16_t drive = -1;  // first drive that failed, 0-based
};

// Judges the proposals for a tick against what was sent in the previous tick and what the drives report. `goal` and
// `live_targets` are the supervisor's orders; while targets are not live, proposals are not looked at. All drives pass,
// or none: after a refusal every drive gets its safe target, as it does while targets are not live: the previous one
// for a drive that has torque and was told to have it, and the actual position for every other drive. A drive in torque
// mode gets no torque and rate 0 with it, which it damps against.
GateResult gate(const GateLimits& limits, DriveGoal goal, bool live_targets, const DriveProposals& proposal,
                const DriveCommands& previous, const DriveFeedbacks& feedback) noexcept;

// The fault of a refusal; number kNone when everything passed.
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

// True when the target may jump from `previous` to `next` because its drive lets go: no further than `let_go`, and its
// way.
constexpr bool is_let_go(std::int32_t previous, std::int32_t next, std::int64_t let_go) noexcept {
  const std::int64_t step = static_cast<std::int64_t>(next) - previous;
  return let_go < 0 ? step < 0 && step >= let_go : step > 0 && step <= let_go;
}

// True when the target goes from `previous` to `next` towards the motor, no more than `limit` counts past it: whoever
// takes a jump back asks for less motion, not for more.
constexpr bool is_taken_back(std::int32_t previous, std::int32_t next, std::int32_t position,
                             std::int64_t limit) noexcept {
  const std::int64_t step = static_cast<std::int64_t>(next) - previous;
  const std::int64_t to_motor = static_cast<std::int64_t>(position) - previous;
  return to_motor < 0 ? step < 0 && step >= to_motor - limit : step > 0 && step <= to_motor + limit;
}

}  // namespace gate_compare

}  // namespace liana
