// What a serial arm adds to the outputs of a tick.
#pragma once

#include <array>
#include <type_traits>

#include "firmware_like/math/ik_outcome.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/serial/push.hpp"
#include "firmware_like/serial/robot_params.hpp"

namespace liana::serial {

// How a push goes, and what sensors say (docs/explanation/force-control.md).
struct InsertStatus {
  std::uint32_t number = 0;  // of the push that was begun last; 0: none yet
  InsertPhase phase = InsertPhase::kNone;
  InsertResult end = InsertResult::kNot;  // why it does not press any more
  InsertLaw law = InsertLaw::kForce;
  WristHealth wrist = WristHealth::kSilent;
  std::uint8_t touched = 0;  // force of contact was felt
  double set_N = 0.0;        // along the axis, now
  double travel_m = 0.0;     // along the axis, from where it began
  double aside_m = 0.0;      // across it
  Wrench felt{};             // by the wrist, as read: on the arm, tip frame
  Wrench given{};            // by the arm, above the tare, tip frame
  std::uint16_t wrist_age_ticks = kNeverHeard;
  std::uint16_t adapter_age_ticks = kNeverHeard;  // since it said anything new
  std::uint8_t adapter_sequence = 0;
  std::uint8_t captured = 0;  // as the adapter said last
  CatchState latch = CatchState::kOpen;
  CatchState lock = CatchState::kOpen;
  std::array<std::uint8_t, 3> depth_01mm{};
};

InsertStatus push_report(const InsertState& push, const WristState& wrist, const AdapterState& adapter) noexcept;

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
      ik_residual{};             // filtered target less tip of the IK, base frame: position [m], rotation vector [rad]
  JointVector torque_told_Nm{};  // torque drives: feed-forward
  InsertStatus push{};
};
static_assert(std::is_trivially_copyable_v<Report>);

}  // namespace liana::serial
