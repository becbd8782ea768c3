#include "firmware_like/safety/conditions.hpp"

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana {
namespace {

constexpr std::array<const char*, 22> kConditionNames{
    "buses_up",    "drives_fresh",    "drives_operational", "no_drive_in_fault", "homed",
    "no_fault",    "all_switched_on", "all_enabled",        "all_off",           "at_rest",
    "tensioned",   "ask_enable",      "ask_stop",           "ask_clear",         "fault_hold",
    "fault_stop",  "fault_immediate", "fault_off",          "counted",           "budget_spent",
    "causes_gone", "fault_persists",
};
static_assert(kFaultPersists == 1u << (kConditionNames.size() - 1), "every condition has a name");

}  // namespace

std::uint32_t drive_conditions_of(const WatchdogLimits& limits, const DriveFeedback& drive) noexcept {
  const DriveState state = decode(drive.statusword);
  const bool fresh = drive.feedback_age_ticks <= kFeedbackAgeTicks && drive.heartbeat_age_ticks <= limits.heartbeat_age_ticks;
  std::uint32_t kept = 0;
  if (fresh) kept |= kDrivesFresh;
  if (drive.operational != 0) kept |= kDrivesOperational;
  if (state != DriveState::kFault && state != DriveState::kFaultReactionActive) kept |= kNoDriveInFault;
  if (fresh && (state == DriveState::kSwitchedOn || state == DriveState::kOperationEnabled)) kept |= kAllSwitchedOn;
  if (fresh && state == DriveState::kOperationEnabled) kept |= kAllEnabled;
  if (fresh && is_off(state)) kept |= kAllOff;
  return kept;
}

std::uint32_t drive_conditions(const WatchdogLimits& limits, const Inputs& inputs) noexcept {
  std::uint32_t kept = kDrivesFresh | kDrivesOperational | kNoDriveInFault | kAllSwitchedOn | kAllEnabled | kAllOff;
  for (std::int32_t i = 0; i < limits.drive_count; ++i) kept &= drive_conditions_of(limits, inputs.drive[as_index(i)]);
  return inputs.lost_bus_mask == 0 ? kept | kBusesUp : kept;
}

std::uint32_t fault_conditions(const FaultList& faults) noexcept {
  std::uint32_t set = 0;
  if (faults.category == StopCategory::kNone) set |= kNoFault;
  if (faults.category >= StopCategory::kHold) set |= kFaultHold;
  if (faults.category >= StopCategory::kStop) set |= kFaultStop;
  if (faults.category >= StopCategory::kOff) set |= kFaultOff;
  if (faults.immediate != 0) set |= kFaultImmediate;
  return set;
}

const char* condition_name(std::uint32_t bit) noexcept {
  for (std::int32_t i = 0; i < static_cast<std::int32_t>(kConditionNames.size()); ++i) {
    if (bit == 1u << static_cast<std::uint32_t>(i)) return kConditionNames[as_index(i)];
  }
  return "unknown";
}

}  // namespace liana
