#include <limits>

#include "tests/bits/planted.hpp"
#include "tests/bits/what_ifs.hpp"

namespace liana::bits {
namespace {

using CableWhatIf = WhatIf<cable::CableArm>;
using Of = Planted<cable::CableArm>;

constexpr std::uint32_t kSlow = 150;  // until the tightest cable is slack, and its debounce

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
// Every tip command asks for a shape as well: a node drawn aside, a point to keep away from.
void shaped(cable::Inputs& inputs, std::uint32_t, std::size_t) {
  cable::Setpoint setpoint = inputs.telecommand.setpoint();
  if (setpoint.kind != CommandKind::kTip) return;
  setpoint.node[0] = {2, {1.2, 0.3, 0.2}, 1.0, 0.0};
  setpoint.clear[0] = {{0.8, 0.1, 0.1}, 0.3, 1.0};
  inputs.telecommand = Release::make(inputs.telecommand.sequence(), inputs.telecommand.first_tick(),
                                     inputs.telecommand.first_tick() + kLife_ticks, 1, setpoint);
}

constexpr CableWhatIf kEnabled[] = {
    {kBrief, Of::silent},
    {kBrief, Of::missing},
    {kBrief, Of::in_fault},
    {kBrief, Of::off},
    {kBrief, Of::not_operational},
    {kBrief, Of::other_mode},
    {kBrief, Of::jumped},
    {kBrief, slack},
    {kSlow, loosening},
    {kBrief, creeping},
    {kBrief, slipped},
    {kBrief, scattering},
    {kBrief, alarming},
    {kBrief, overloaded},
    {kBrief, Of::bus_lost},
    {kBrief, Of::twice},
    {kBrief, Of::late},
    {kBrief, Of::nonsense},
    {kBrief, Of::no_telecommands},
    {kLong, shaped},
    {kLong, Of::straightened},
    {kLong, Of::stop},
    {kLong, Of::silent_then_cleared},
};
constexpr CableWhatIf kEnabling[] = {
    {kLong, Of::off},
};

}  // namespace

template <>
std::span<const CableWhatIf> what_ifs_enabled() {
  return kEnabled;
}
template <>
std::span<const CableWhatIf> what_ifs_enabling() {
  return kEnabling;
}

}  // namespace liana::bits
