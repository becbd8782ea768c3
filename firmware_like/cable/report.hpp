// What a cable arm adds to the outputs of a tick.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/contact_detector.hpp"
#include "firmware_like/cable/motion/servo_ik.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana::cable {

// What is known of friction between cables and holes (arm/friction_watch.hpp).
struct FrictionStatus {
  double mu = 0.0;                   // found while the arm moves; before that what was declared
  double sd = 0.0;                   // its standard deviation
  double planned_mu = 0.0;           // what the arm plans with
  std::uint8_t not_as_declared = 0;  // 1: found to be another one than the robot table or the calibration says
};

// What touches the arm (arm/contact_watch.hpp).
struct ContactStatus {
  Vec3 force_N{};         // on the tip, base frame; 0 along axes that are not seen
  Vec3 sd_N{};            // its standard deviation along each axis
  std::uint8_t seen = 0;  // bit i: the force along axis i is known to better than kContactSeen_N
  ContactState state = ContactState::kStuck;
  std::uint8_t on_body = 0;  // 1: something other than a push on the tip touches the arm
  std::int32_t segment = 0;  // 1-based, where; 0: nowhere, or it cannot be named
  double torque_Nm = 0.0;    // about the angle that feels most of what nothing explains
};

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
  double speed_share = 1.0, turn_share = 1.0;  // of the tip's limits that the governor leaves here
  double lost_share = 1.0;  // of the way to the tip's target: less where the arm has all but lost a direction of it
  ThetaVector load_Nm{};    // that the planned tensions give about each theta: what the arm's mass takes
  CableVector tension_plan_N{};      // at the motor; 0: an enabled arm does without this cable
  CableVector tension_measured_N{};  // at the motor: by load cell, or by the drive's torque
  std::uint32_t load_cells = 0;      // bit i: that of cable i is by its load cell
  CableVector payout_command_m{};    // unstretched length
  FrictionStatus friction{};
  ContactStatus contact{};
  double ik_position_error_m = 0.0;
  double ik_attitude_error_rad = 0.0;
  IkOutcome ik_outcome = IkOutcome::kConverged;
  std::array<double, 6>
      ik_residual{};  // filtered target less tip of the IK, base frame: position [m], rotation vector [rad]
};

}  // namespace liana::cable
