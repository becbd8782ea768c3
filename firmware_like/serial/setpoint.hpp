// What a serial arm is asked to do.
#pragma once

#include <type_traits>

#include "firmware_like/command/telecommand.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/robot_table.hpp"

namespace liana::serial {

// What a device, mission or client asks for; not yet verified.
struct Setpoint {
  CommandKind kind = CommandKind::kNone;
  Pose tip_in_base{};          // kTip
  JointVector joint_rad{};     // kJoint, kRetreat
  double tip_speed_m_s = 0.0;  // kTip: limit for this motion, > 0; the robot's own limit holds besides
};
static_assert(std::is_trivially_copyable_v<Setpoint>);

// True when the core can act on it: finite, a valid pose, joints inside their ranges, a speed above 0. Hold and stop
// always are.
bool is_usable(const RobotTable& table, const Setpoint& setpoint) noexcept;

}  // namespace liana::serial
