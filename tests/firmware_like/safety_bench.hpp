// A small robot and healthy drives for the tests of the drive and safety stages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware_like/cable/arm/drive_limits.hpp"
#include "firmware_like/cable/arm/tension_monitor.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"

namespace liana::cable::safety_bench {

// Statuswords as a drive sends them: voltage (bit 4) and remote (bit 9) set beside the state bits.
constexpr std::uint16_t kStatusDisabled = 0x0250;
constexpr std::uint16_t kStatusReady = 0x0231;
constexpr std::uint16_t kStatusSwitchedOn = 0x0233;
constexpr std::uint16_t kStatusEnabled = 0x1237;
constexpr std::uint16_t kStatusQuickStop = 0x0217;
constexpr std::uint16_t kStatusFaultReaction = 0x021F;
constexpr std::uint16_t kStatusFault = 0x0218;

constexpr std::int32_t kDrives = 6;
constexpr Patience kTimeout_s = patience(0.004);
constexpr double kMetresPerCount = 1e-6;
constexpr double kZeroPayout_m = 1.3;

// Two segments of eight modules with three cables each; the limits are those of zhu2022.
inline RobotParams table() {
  RobotParams robot{};
  robot.segment_count = 2;
  for (std::size_t m = 0; m < 2; ++m) {
    robot.segment[m].modules = 8;
    robot.segment[m].cables = 3;
    robot.segment[m].module_length_m = 0.1;
    robot.segment[m].theta_limit_rad = 0.35;
    robot.segment[m].hole_radius_m = 0.025;
    robot.segment[m].face_offset_m = 0.010;
  }
  robot.cable_EA_N = 240000.0;
  robot.servo_time_constant_s = 0.03;
  robot.tick_s = 0.004;
  robot.interval_ticks = 5;
  robot.tension = {40.0, 15.0, 1.0, 150.0, 400.0, 600.0};
  robot.limits.cable_speed_m_s = 0.010;
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    robot.drive[i] = {kMetresPerCount, i % 2 == 0 ? 1 : -1, 1000000, 0.6};
  }
  return robot;
}

// Payout of every cable at zero_counts.
inline CableVector zero_payout_m() {
  CableVector payout{};
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) payout[i] = kZeroPayout_m;
  return payout;
}

// Inputs of a tick in which every drive is alive, operational and shows `statusword`, standing at its zero.
inline CycleInputs healthy(std::uint16_t statusword, std::uint64_t tick = 1) {
  CycleInputs inputs{};
  inputs.tick = tick;
  for (std::size_t i = 0; i < static_cast<std::size_t>(kDrives); ++i) {
    inputs.drive[i].statusword = statusword;
    inputs.drive[i].position_counts = 1000000;
    inputs.drive[i].feedback_age_ticks = 0;
    inputs.drive[i].heartbeat_age_ticks = 0;
    inputs.drive[i].operational = 1;
  }
  return inputs;
}

// The watchdogs of a cable arm with the states they keep, run as in a tick.
struct Watchdogs {
  LinkLimits link_limits = make_link_limits(table());
  TensionWatchLimits tension_limits = make_tension_watch_limits(table());
  DriveLinkMonitorState link{};
  TensionMonitorState tension{};

  // How many conditions are wrong now.
  std::int32_t run(WatchScope scope, const CycleInputs& inputs, const DriveCommands& sent, const CableVector& tension_N,
                   const CableVector& lowpass_N, FaultList& faults) {
    Watch out(inputs.tick, faults);
    watch_cycle(scope, inputs, out);
    for (std::int32_t drive = 0; drive < link_limits.drive_count; ++drive) {
      const std::size_t i = as_index(drive);
      watch_drive(link_limits, scope, inputs.drive[i], drive, link, out);
      const TensionReading now{tension_N[i], lowpass_N[i], link.following_ticks[i] == 0};
      watch_tension(tension_limits, scope, now, drive, tension, out);
      watch_following(link_limits, scope, inputs.drive[i], sent[i], drive, link, out);
    }
    return out.active();
  }
};

// True when `faults` holds this number for this drive or bus.
inline bool has(const FaultList& faults, FaultNumber number, std::int16_t index) {
  for (std::int32_t i = 0; i < faults.count; ++i) {
    const Fault& fault = faults.fault[static_cast<std::size_t>(i)];
    if (fault.number == number && fault.index == index) return true;
  }
  return false;
}

}  // namespace liana::cable::safety_bench
