// What a cable arm adds to the outputs of a tick.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/robot_table.hpp"
#include "firmware_like/cable/motion/servo_ik.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana::cable {

struct Report {
  std::uint32_t held_mask = 0;
  std::uint8_t held_at_target = 0;  // every held variable stands exactly at its target
  ThetaVector theta_command_rad{};  // after the limiter
  ThetaVector theta_rate_rad_s{};
  ThetaVector theta_measured_rad{};  // estimate from motor lengths with elongation removed
  Pose tip_goal{};                   // filtered operator target
  Pose tip_command{};                // kinematics of theta_command
  double tip_speed_m_s = 0.0;        // of the command
  double tip_rate_rad_s = 0.0;
  std::array<Vec3, kMaxSegments> node_command_m{};
  CableVector tension_plan_N{};      // at the motor
  CableVector tension_measured_N{};  // from drive torque
  CableVector payout_command_m{};    // unstretched length
  double ik_position_error_m = 0.0;
  double ik_attitude_error_rad = 0.0;
  IkOutcome ik_outcome = IkOutcome::kConverged;
  std::array<double, 6>
      ik_residual{};  // filtered target less tip of the IK, base frame: position [m], rotation vector [rad]
};

}  // namespace liana::cable
