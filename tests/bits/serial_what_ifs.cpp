#include "tests/bits/planted.hpp"
#include "tests/bits/what_ifs.hpp"

namespace liana::bits {
namespace {

using SerialWhatIf = WhatIf<serial::SerialArm>;
using Of = Planted<serial::SerialArm>;

// 0.03 deg a tick away from where it is told to be: slower than a joint may turn from one reading to the next.
void lagging(serial::Inputs& inputs, std::uint32_t age, std::size_t drive) {
  inputs.drive[drive].position_counts += 100 * static_cast<std::int32_t>(age);
}
// Every tip command goes on to a place that the arm cannot reach, at full speed.
void out_of_reach(serial::Inputs& inputs, std::uint32_t, std::size_t) {
  serial::Setpoint setpoint = inputs.telecommand.setpoint();
  if (setpoint.kind != CommandKind::kTip) return;
  for (double& place_m : setpoint.tip_in_base.position_m) place_m *= 3.0;
  setpoint.tip_speed_m_s = 1.0;
  inputs.telecommand = Release::make(inputs.telecommand.sequence(), inputs.telecommand.first_tick(),
                                     inputs.telecommand.first_tick() + kLife_ticks, 1, setpoint);
}

// The wrist's sensor in a push, and what it may feel there.
void wrist_silent(serial::Inputs& inputs, std::uint32_t age, std::size_t) {
  inputs.sensors.wrist.age_ticks = static_cast<std::uint16_t>(age + 1);
}
void wrist_failed(serial::Inputs& inputs, std::uint32_t, std::size_t) {
  inputs.sensors.wrist.status = serial::WristStatus::kFailed;
}
void a_blow(serial::Inputs& inputs, std::uint32_t, std::size_t) { inputs.sensors.wrist.on_arm.force_N[2] -= 300.0; }
void captured_early(serial::Inputs& inputs, std::uint32_t age, std::size_t) {
  inputs.sensors.adapter.captured = 1;
  inputs.sensors.adapter.sequence = static_cast<std::uint8_t>(age);
  inputs.sensors.adapter.age_ticks = 0;
}

constexpr SerialWhatIf kEnabled[] = {
    {kBrief, Of::silent},
    {kBrief, Of::missing},
    {kBrief, Of::in_fault},
    {kBrief, Of::off},
    {kBrief, Of::not_operational},
    {kBrief, Of::other_mode},
    {kBrief, Of::jumped},
    {kBrief, lagging},
    {kBrief, Of::bus_lost},
    {kBrief, Of::twice},
    {kBrief, Of::late},
    {kBrief, Of::nonsense},
    {kBrief, Of::no_telecommands},
    {kLong, out_of_reach},
    {kLong, Of::straightened},
    {kLong, Of::stop},
    {kLong, Of::silent_then_cleared},
    {kBrief, wrist_silent},
    {kBrief, wrist_failed},
    {kBrief, a_blow},
    {kBrief, captured_early},
};
constexpr SerialWhatIf kEnabling[] = {
    {kLong, Of::off},
};

}  // namespace

template <>
std::span<const SerialWhatIf> what_ifs_enabled() {
  return kEnabled;
}
template <>
std::span<const SerialWhatIf> what_ifs_enabling() {
  return kEnabling;
}

}  // namespace liana::bits
