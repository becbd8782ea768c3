// What is wrong with a serial arm's joints, from their absolute encoders alone.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::serial {

constexpr double kJumpWindow_rad = 5e-4;  // besides, for noise of the encoder; at most one tick's way at 7 deg/s
constexpr std::uint16_t kRangeDebounceTicks = 2;  // one wrong reading is a jump, and no joint out of its range

// One joint as it was read last.
struct JointReading {
  double joint_rad = 0.0;
  bool heard = false;   // at least once
  bool jumped = false;  // from the reading before to this one
};

struct JointMonitorState {
  std::array<JointReading, kMaxJoints> reading{};
  std::array<std::uint16_t, kMaxJoints> outside_ticks{};
};

// Takes a drive's feedback; a message that is not of this tick changes nothing.
void read_joint(const RobotParams& table, const DriveFeedback& drive, std::int32_t joint,
                JointMonitorState& state) noexcept;

// True when every joint was heard, did not jump and is inside its range (kRangeMargin_rad).
bool is_plausible(const RobotParams& table, const JointMonitorState& state) noexcept;

// Latches a joint that jumped, and one that is out of its range while its drive has power.
void watch_joint(const RobotParams& table, WatchScope scope, std::int32_t joint, JointMonitorState& state,
                 Watch& out) noexcept;

}  // namespace liana::serial
