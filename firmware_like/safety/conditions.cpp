#include "firmware_like/safety/conditions.hpp"

#include "firmware_like/drive/cia402.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana {
namespace {

constexpr std::array<const char*, 22> kConditionNames{
    "buses_up",    "drives_fresh",    "drives_operational", "no_drive_in_fault", "homed",
    "no_fault",    "all_switched_on", "all_enabled",        "all_off",           "at_rest",
    "prepared",    "ask_enable",      "ask_stop",           "ask_clear",         "fault_hold",
    "fault_stop",  "fault_immediate", "fault_off",          "counted",           "budget_spent",
    "causes_gone", "fault_persists",
};
static_assert(kFaultPersists == 1u << (kConditionNames.size() - 1), "every condition has a name");

}  // namespace

namespace {

// What each drive state says.
constexpr std::array<std::uint32_t, kDriveStateCount> kConditionsOfState = [] {
  std::array<std::uint32_t, kDriveStateCount> of{};
  for (std::size_t i = 0; i < of.size(); ++i) {
    const auto state = static_cast<DriveState>(i);
    if (state != DriveState::kFault && state != DriveState::kFaultReactionActive) of[i] |= kNoDriveInFault;
    if (state == DriveState::kSwitchedOn || state == DriveState::kOperationEnabled) of[i] |= kAllSwitchedOn;
    if (state == DriveState::kOperationEnabled) of[i] |= kAllEnabled;
    if (is_off(state)) of[i] |= kAllOff;
  }
  return of;
}();

}  // namespace

std::uint32_t drive_conditions_of(const LinkLimits& limits, const DriveFeedback& drive) noexcept {
  const bool fresh =
      drive.feedback_age_ticks <= kFeedbackAgeTicks && drive.heartbeat_age_ticks <= limits.heartbeat_age_ticks;
  const std::uint32_t of_state = kConditionsOfState[as_index(static_cast<std::int32_t>(decode(drive.statusword)))];
  const std::uint32_t kept =
      fresh ? of_state | kDrivesFresh : of_state & kNoDriveInFault;  // an old statusword proves only a fault
  return drive.operational != 0 ? kept | kDrivesOperational : kept;
}

std::uint32_t drive_conditions(const LinkLimits& limits, const CycleInputs& inputs) noexcept {
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
