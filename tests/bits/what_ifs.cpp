#include "tests/bits/what_ifs.hpp"

#include <limits>

#include "firmware_like/command/release.hpp"

namespace liana::bits {
namespace {

constexpr std::uint32_t kBrief = 60;  // longer than every debounce, and than the quick stop takes to begin
constexpr std::uint32_t kLong = 400;  // until the drives are without power, or are asked too long for it; and a motion
constexpr std::uint32_t kSlow = 150;  // until the tightest cable is slack, and its debounce
constexpr std::uint64_t kLife_ticks = 1000;
constexpr std::uint64_t kUnusedSequence = 1u << 30;
constexpr std::uint16_t kSwitchOnDisabled = 0x0250, kInFault = 0x0218;

void silent(cable::Inputs& inputs, std::uint32_t age, std::size_t drive) {
  inputs.drive[drive].feedback_age_ticks = static_cast<std::uint16_t>(age + 1);
}
void missing(cable::Inputs& inputs, std::uint32_t, std::size_t drive) {
  inputs.drive[drive].heartbeat_age_ticks = 1000;
}
void in_fault(cable::Inputs& inputs, std::uint32_t age, std::size_t drive) {
  inputs.drive[drive].statusword = kInFault;
  inputs.drive[drive].emergency_code = age == 1 ? 0x2310 : 0;
}
void off(cable::Inputs& inputs, std::uint32_t, std::size_t drive) {
  inputs.drive[drive].statusword = kSwitchOnDisabled;
}
void not_operational(cable::Inputs& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].operational = 0; }
void jumped(cable::Inputs& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].position_counts += 200000; }
void slack(cable::Inputs& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].torque_permille = 0; }
// So slowly that it is no break.
void loosening(cable::Inputs& inputs, std::uint32_t age, std::size_t drive) {
  const std::int32_t left = inputs.drive[drive].torque_permille - 2 * static_cast<std::int32_t>(age);
  inputs.drive[drive].torque_permille = static_cast<std::int16_t>(left > 0 ? left : 0);
}
// 14 um a tick that its tension does not know of.
void creeping(cable::Inputs& inputs, std::uint32_t age, std::size_t drive) {
  inputs.drive[drive].position_counts += 10 * static_cast<std::int32_t>(age);
}
void slipped(cable::Inputs& inputs, std::uint32_t, std::size_t drive) {
  inputs.drive[drive].torque_permille = static_cast<std::int16_t>(inputs.drive[drive].torque_permille - 20);
}
void scattering(cable::Inputs& inputs, std::uint32_t age, std::size_t drive) {
  if (age % 2 == 0)
    inputs.drive[drive].torque_permille = static_cast<std::int16_t>(inputs.drive[drive].torque_permille + 40);
}
void alarming(cable::Inputs& inputs, std::uint32_t, std::size_t drive) { inputs.drive[drive].torque_permille = 800; }
void overloaded(cable::Inputs& inputs, std::uint32_t, std::size_t drive) {
  inputs.drive[drive].torque_permille = std::numeric_limits<std::int16_t>::max();
}
void bus_lost(cable::Inputs& inputs, std::uint32_t, std::size_t) { inputs.lost_bus_mask = 2; }
void late(cable::Inputs& inputs, std::uint32_t age, std::size_t) { inputs.lost_ticks = age == 0 ? 10 : 0; }
void nonsense(cable::Inputs& inputs, std::uint32_t age, std::size_t) {
  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kJoint;
  setpoint.joint_rad[3] = std::numeric_limits<double>::quiet_NaN();
  inputs.telecommand = Release::make(kUnusedSequence + age, inputs.tick, inputs.tick + kLife_ticks, 1, setpoint);
}
// Every tip command asks for a shape as well: a node drawn aside, a point to keep away from.
void shaped(cable::Inputs& inputs, std::uint32_t, std::size_t) {
  cable::Setpoint setpoint = inputs.telecommand.setpoint();
  if (setpoint.kind != CommandKind::kTip) return;
  setpoint.node[0] = {2, {1.2, 0.3, 0.2}, 1.0, 0.0};
  setpoint.clear[0] = {{0.8, 0.1, 0.1}, 0.3, 1.0};
  inputs.telecommand = Release::make(inputs.telecommand.sequence(), inputs.telecommand.first_tick(),
                                     inputs.telecommand.first_tick() + kLife_ticks, 1, setpoint);
}
void straightened(cable::Inputs& inputs, std::uint32_t age, std::size_t) {
  cable::Setpoint setpoint;
  setpoint.kind = age == 0 ? CommandKind::kJoint : CommandKind::kNone;
  inputs.telecommand = Release::make(kUnusedSequence, inputs.tick, inputs.tick + kLife_ticks, 1, setpoint);
}
void no_telecommands(cable::Inputs& inputs, std::uint32_t, std::size_t) { inputs.telecommand = cable::Telecommand{}; }
void stop(cable::Inputs& inputs, std::uint32_t age, std::size_t) {
  inputs.request = age == 0 ? Request::kStop : Request::kNone;
}
void silent_then_cleared(cable::Inputs& inputs, std::uint32_t age, std::size_t drive) {
  if (age < 10) silent(inputs, age, drive);
  if (age > 150) {
    for (DriveFeedback& each : inputs.drive) each.statusword = kSwitchOnDisabled;
  }
  inputs.request = age == 300 ? Request::kClear : Request::kNone;
}

constexpr WhatIf kEnabled[] = {
    {kBrief, silent},
    {kBrief, missing},
    {kBrief, in_fault},
    {kBrief, off},
    {kBrief, not_operational},
    {kBrief, jumped},
    {kBrief, slack},
    {kSlow, loosening},
    {kBrief, creeping},
    {kBrief, slipped},
    {kBrief, scattering},
    {kBrief, alarming},
    {kBrief, overloaded},
    {kBrief, bus_lost},
    {kBrief, late},
    {kBrief, nonsense},
    {kBrief, no_telecommands},
    {kLong, shaped},
    {kLong, straightened},
    {kLong, stop},
    {kLong, silent_then_cleared},
};
constexpr WhatIf kEnabling[] = {
    {kLong, off},
};

}  // namespace

std::span<const WhatIf> what_ifs_enabled() { return kEnabled; }
std::span<const WhatIf> what_ifs_enabling() { return kEnabling; }

}  // namespace liana::bits
