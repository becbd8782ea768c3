// Everything that enters and leaves one tick.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware_like/arm/robot_table.hpp"
#include "firmware_like/math/pose.hpp"
#include "firmware_like/motion/servo_ik.hpp"
#include "firmware_like/safety/faults.hpp"
#include "firmware_like/telecommand.hpp"

namespace liana {

// What one drive reported; ages count ticks since the last message (0 = in this tick).
struct DriveFeedback {
  std::uint16_t statusword = 0;      // 6041
  std::int16_t torque_permille = 0;  // 6077
  std::int32_t position_counts = 0;  // 6064
  std::uint16_t feedback_age_ticks = 0xFFFF;
  std::uint16_t heartbeat_age_ticks = 0xFFFF;
  std::uint16_t emergency_code = 0;  // last EMCY error code of this tick, 0 = none
  std::uint8_t operational = 0;      // NMT state is operational
};

// What an operator or client asks of the state machine; acts on the tick that carries it.
enum class Request : std::uint8_t { kNone = 0, kEnable = 1, kDisable = 2, kClear = 3, kStop = 4 };

struct Inputs {
  std::uint64_t tick = 0;
  std::uint32_t lost_ticks = 0;     // deadlines missed just before this tick
  std::uint32_t lost_bus_mask = 0;  // bit b: bus b is down
  Request request = Request::kNone;
  Telecommand telecommand{};  // kind kNone when nothing new was released
  std::array<DriveFeedback, kMaxCables> drive{};
};

// CRTK-like operating states.
enum class OperatingState : std::uint8_t { kDisabled = 0, kEnabling = 1, kEnabled = 2, kStopping = 3, kFault = 4 };

// Every limit that acted in this tick names itself (bits of Outputs::limits).
enum LimitBit : std::uint32_t {
  kLimitTipSpeed = 1u << 0,
  kLimitTipAccel = 1u << 1,
  kLimitTheta = 1u << 2,
  kLimitThetaRate = 1u << 3,
  kLimitThetaAccel = 1u << 4,
  kLimitCableSpeed = 1u << 5,
  kLimitTensionFloor = 1u << 6,
  kLimitTensionCeiling = 1u << 7,
  kLimitSingular = 1u << 8,
  kLimitGate = 1u << 9,
  kLimitExpired = 1u << 10,  // no valid telecommand: the arm holds
  kLimitReach = 1u << 11,    // the target is farther away than the arm is long
};

struct DriveCommand {
  std::uint16_t controlword = 0;   // 6040
  std::int32_t target_counts = 0;  // 607A
};

struct Outputs {
  std::uint64_t tick = 0;
  OperatingState state = OperatingState::kDisabled;
  StopCategory stop_category = StopCategory::kNone;
  std::uint32_t limits = 0;  // LimitBit
  std::uint32_t held_mask = 0;
  std::uint8_t held_at_target = 0;    // every held variable stands exactly at its target
  std::uint8_t at_rest = 0;           // commanded motion has ended
  std::uint8_t homed = 0;             // measured theta is trusted
  std::uint64_t active_sequence = 0;  // telecommand in force, 0 = none
  FaultList faults{};
  std::array<DriveCommand, kMaxCables> drive{};
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
  std::array<double, 6> ik_residual{};  // filtered target less tip of the IK, base frame: position [m], rotation vector [rad]
};

static_assert(std::is_trivially_copyable_v<Inputs>);
static_assert(std::is_trivially_copyable_v<Outputs>);

}  // namespace liana
