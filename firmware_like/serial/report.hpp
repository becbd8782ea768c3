// What a serial arm adds to the outputs of a tick.
#pragma once

#include <array>
#include <type_traits>

#include "firmware_like/math/ik_outcome.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/robot_table.hpp"

namespace liana::serial {

struct Report {
  JointVector joint_command_rad{};  // after the limiter
  JointVector joint_rate_rad_s{};
  JointVector joint_measured_rad{};  // from the absolute encoders
  JointVector torque_measured_Nm{};  // at the joints, from drive torque
  Pose tip_goal{};                   // filtered operator target
  Pose tip_command{};                // kinematics of joint_command
  double tip_speed_m_s = 0.0;        // of the command
  double tip_rate_rad_s = 0.0;
  double ik_position_error_m = 0.0;
  double ik_attitude_error_rad = 0.0;
  IkOutcome ik_outcome = IkOutcome::kConverged;
  std::array<double, 6>
      ik_residual{};  // filtered target less tip of the IK, base frame: position [m], rotation vector [rad]
};
static_assert(std::is_trivially_copyable_v<Report>);

}  // namespace liana::serial
