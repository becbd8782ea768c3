// What an arm adds to its table when its drives follow torques instead of positions
// (docs/explanation/force-control.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "firmware_like/serial/mass_table.hpp"

namespace liana::serial {

// What a push may choose (force_law.hpp): which number of InsertGains is which.
enum PushGain : std::size_t {
  kPushMass,        // M_d along the axes [kg]
  kPushInertia,     // M_d about them [kg.m2]
  kAxialDamping,    // K_D along the insertion axis [N.s/m]
  kLateralDamping,  // across it [N.s/m]
  kTurnDamping,     // of turning [N.m.s/rad]
  kForceGain,       // K_P C_F: force law, of what is missing of the set force [1]
  kStiffness,       // K_P of impedance [N/m]
  kTurnStiffness,   // [N.m/rad]
  kApproachSpeed,   // of the point that impedance pulls to, along the axis [m/s]
  kUnloadDamping,   // K_D along the axis from capture on [N.s/m]
  kPushGainCount
};
using InsertGains = std::array<double, kPushGainCount>;

// All zero, and without effect, for an arm whose drives follow positions.
struct TorqueParams {
  std::uint8_t is_torque_controlled = 0;  // 1: the drives run in cyclic synchronous torque
  MassTable masses{};                     // of the links, for the torque that a motion takes
  double coulomb_Nm = 0.0;                // friction of each joint, as declared
  double viscous_Nms_per_rad = 0.0;
  double position_gain_per_s = 0.0;  // joint rate for a joint that is off its target
  double most_joint_Nm = 0.0;        // that a push may ask of a joint
  double most_force_N = 0.0;         // on the tip, in a push; what is set is below it
  double most_travel_m = 0.0;        // along the axis, from where a push began
  double most_aside_m = 0.0;         // across it
  double most_turn_rad = 0.0;
  std::uint16_t wrist_still_samples = 0;  // with the very same numbers, and the wrist's sensor is stuck; 0: never
  InsertGains gain_low{};                 // range of each gain that a push may ask for
  InsertGains gain_high{};
};
static_assert(std::is_trivially_copyable_v<TorqueParams>);

}  // namespace liana::serial
