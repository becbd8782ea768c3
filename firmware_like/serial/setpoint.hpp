// What a serial arm is asked to do.
#pragma once

#include <type_traits>

#include "firmware_like/command/telecommand.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/force_law.hpp"
#include "firmware_like/serial/mass_table.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::serial {

// A push along an axis of the tip, and what ends it (docs/explanation/force-control.md).
struct Push {
  std::uint32_t number = 0;  // > 0: another number begins another push, the same goes on with the one under way
  InsertLaw law = InsertLaw::kForce;
  std::uint8_t tares = 1;           // 1: what the sensor says at the beginning is taken for nothing
  Vec3 axis_in_tip{0.0, 0.0, 1.0};  // unit, the way in
  double force_N = 0.0;             // along it, >= 0
  double travel_m = 0.0;            // the most along the axis, from where it began, forward or back
  double aside_m = 0.0;             // the most across it
  double turn_rad = 0.0;            // the most that the tip turns
  double depth_m = 0.0;             // impedance: where the stop is expected
  InsertGains gains{};
};

// What a device, mission or client asks for; not yet verified.
struct Setpoint {
  CommandKind kind = CommandKind::kNone;
  Pose tip_in_base{};          // kTip
  JointVector joint_rad{};     // kJoint, kRetract
  double tip_speed_m_s = 0.0;  // kTip: limit for this motion, > 0; the robot's own limit holds besides
  Push push{};                 // kPush
  LinkMass payload_at_tip{};   // all that move: what the arm carries, in the tip's frame; torque drives are told of it
};
static_assert(std::is_trivially_copyable_v<Setpoint>);

// True when the core can act on it: finite, a valid pose, joints inside their ranges, a speed above 0, a payload that
// is a body; a push inside the table's bounds, of an arm that gives torque. Hold and stop always are.
bool is_usable(const RobotParams& table, const Setpoint& setpoint) noexcept;

}  // namespace liana::serial
