// What can happen to the drives, the buses and the clients of any arm: the part of what_ifs.hpp that both arms share.
#pragma once

#include <cstdint>
#include <limits>

#include "firmware_like/command/release.hpp"
#include "firmware_like/controller_io.hpp"

namespace liana::bits {

constexpr std::uint32_t kBrief = 60;  // longer than every debounce, and than the quick stop takes to begin
constexpr std::uint32_t kLong = 400;  // until the drives are without power, or are asked too long for it; and a motion
constexpr std::uint64_t kLife_ticks = 1000;
constexpr std::uint64_t kUnusedSequence = 1u << 30;
constexpr std::uint16_t kSwitchOnDisabled = 0x0250, kInFault = 0x0218;

template <class Arm>
struct Planted {
  using In = Inputs<Arm>;
  using Setpoint = typename Arm::Setpoint;

  static void silent(In& inputs, std::uint32_t age, std::size_t drive) {
    inputs.drive[drive].feedback_age_ticks = static_cast<std::uint16_t>(age + 1);
  }
  static void missing(In& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].heartbeat_age_ticks = 1000; }
  static void in_fault(In& inputs, std::uint32_t age, std::size_t drive) {
    inputs.drive[drive].statusword = kInFault;
    inputs.drive[drive].emergency_code = age == 1 ? 0x2310 : 0;
  }
  static void off(In& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].statusword = kSwitchOnDisabled; }
  static void not_operational(In& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].operational = 0; }
  static void other_mode(In& inputs, std::uint32_t, std::size_t drive) {
    inputs.drive[drive].operational = kInOtherMode;
  }
  static void jumped(In& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].position_counts += 200000; }
  static void bus_lost(In& inputs, std::uint32_t, std::size_t) { inputs.lost_bus_mask = 2; }
  static void twice(In& inputs, std::uint32_t, std::size_t drive) { inputs.twice_mask = 1u << drive; }
  static void late(In& inputs, std::uint32_t age, std::size_t) { inputs.lost_ticks = age == 0 ? 10 : 0; }

  static void nonsense(In& inputs, std::uint32_t age, std::size_t) {
    Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    setpoint.joint_rad[3] = std::numeric_limits<double>::quiet_NaN();
    inputs.telecommand = Release::make(kUnusedSequence + age, inputs.tick, inputs.tick + kLife_ticks, 1, setpoint);
  }
  static void straightened(In& inputs, std::uint32_t age, std::size_t) {
    Setpoint setpoint;
    setpoint.kind = age == 0 ? CommandKind::kJoint : CommandKind::kNone;
    inputs.telecommand = Release::make(kUnusedSequence, inputs.tick, inputs.tick + kLife_ticks, 1, setpoint);
  }
  static void no_telecommands(In& inputs, std::uint32_t, std::size_t) { inputs.telecommand = {}; }
  static void stop(In& inputs, std::uint32_t age, std::size_t) {
    inputs.request = age == 0 ? Request::kStop : Request::kNone;
  }
  static void silent_then_cleared(In& inputs, std::uint32_t age, std::size_t drive) {
    if (age < 10) silent(inputs, age, drive);
    if (age > 150) {
      for (DriveFeedback& each : inputs.drive) each.statusword = kSwitchOnDisabled;
    }
    inputs.request = age == 300 ? Request::kClear : Request::kNone;
  }
};

}  // namespace liana::bits
