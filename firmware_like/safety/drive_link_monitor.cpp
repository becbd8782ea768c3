#include "firmware_like/safety/drive_link_monitor.hpp"

namespace liana {
namespace {

// Heartbeat, NMT state and age of feedback, for a drive that has been alive, or should have been.
void watch_link(const LinkLimits& limits, const DriveFeedback& drive, std::int32_t i, DriveLinkMonitorState& state,
                Watch& out) noexcept {
  const std::uint32_t bit = 1U << static_cast<std::uint32_t>(i);
  const bool silent = drive.feedback_age_ticks > kFeedbackAgeTicks;
  const bool missing = drive.heartbeat_age_ticks > limits.heartbeat_age_ticks;
  if (!silent && !missing && drive.operational != 0) state.seen_mask |= bit;
  if ((state.seen_mask & bit) == 0) return;
  if (silent) out.wrong(FaultNumber::kDriveSilent, i, drive.feedback_age_ticks);
  if (missing) out.wrong(FaultNumber::kDriveMissing, i, drive.heartbeat_age_ticks);
  if (drive.operational == 0) out.wrong(FaultNumber::kDriveNotOperational, i, 0);
}

// Fault and operation state. The emergency frame may come a tick before or after the statusword, so the code is kept.
void watch_state(WatchScope scope, const DriveFeedback& drive, std::int32_t i, DriveLinkMonitorState& state,
                 Watch& out) noexcept {
  std::uint16_t& code = state.emergency_code[as_index(i)];
  if (drive.emergency_code != 0) code = drive.emergency_code;
  const DriveState now = decode(drive.statusword);
  if (now == DriveState::kFault || now == DriveState::kFaultReactionActive) {
    out.wrong(FaultNumber::kDriveFault, i, code);
  } else {
    if (scope.powered && now != DriveState::kOperationEnabled) {
      out.wrong(FaultNumber::kDriveLeftOperation, i, drive.statusword);
    }
    if (drive.operational == kInOtherMode && scope.powered && now == DriveState::kOperationEnabled)
      out.wrong(FaultNumber::kDriveOtherMode, i, 0);
    if (drive.emergency_code == 0) code = 0;
  }
}

}  // namespace

void Watch::wrong(FaultNumber number, std::int32_t index, std::uint16_t detail) noexcept {
  latch(faults_, {number, narrow<std::int16_t>(index), detail, tick_});
  ++active_;
}

void Watch::debounced(bool is_wrong, std::uint16_t debounce, std::uint16_t& ticks, FaultNumber number,
                      std::int32_t index) noexcept {
  if (!is_wrong) {
    ticks = 0;
    return;
  }
  if (ticks < debounce) ++ticks;
  if (ticks >= debounce) wrong(number, index, 0);
}

void watch_cycle(WatchScope scope, const CycleInputs& inputs, Watch& out) noexcept {
  for (std::int32_t bus = 0; inputs.lost_bus_mask != 0 && bus < 32; ++bus) {
    if ((inputs.lost_bus_mask >> static_cast<std::uint32_t>(bus)) & 1U) out.wrong(FaultNumber::kBusLost, bus, 0);
  }
  for (std::int32_t drive = 0; inputs.twice_mask != 0 && drive < kMaxDrives; ++drive) {
    if ((inputs.twice_mask >> static_cast<std::uint32_t>(drive)) & 1U) out.wrong(FaultNumber::kNodeTwice, drive, 0);
  }
  if (scope.powered && inputs.lost_ticks > kToleratedLostTicks) {
    out.wrong(FaultNumber::kTicksLost, -1, narrow<std::uint16_t>(inputs.lost_ticks));
  }
}

void watch_doubtful_drive(const LinkLimits& limits, WatchScope scope, const DriveFeedback& drive, std::int32_t index,
                          DriveLinkMonitorState& state, Watch& out) noexcept {
  watch_link(limits, drive, index, state, out);
  watch_state(scope, drive, index, state, out);
}

}  // namespace liana
