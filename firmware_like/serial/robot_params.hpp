// The serial arm as the core sees it: plain numbers, checked once by the loader, constant afterwards.
#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "firmware_like/serial/torque_params.hpp"

namespace liana::serial {

// One row of the standard Denavit-Hartenberg table: turn by theta + offset about z, shift d along z, shift a along the
// new x, turn by alpha about the new x.
struct DhRow {
  double alpha_rad = 0.0;
  double a_m = 0.0;
  double d_m = 0.0;
  double offset_rad = 0.0;  // of the joint angle at which the row's theta is 0
};

// One revolute joint and the link behind it.
struct JointParams {
  DhRow dh{};
  double low_rad = 0.0;   // range of the joint angle, low < high
  double high_rad = 0.0;  // |low|, |high| <= 4 pi
  double rate_rad_s = 0.0;
  double accel_rad_s2 = 0.0;
};

// What bounds the filtered tip target (operator_input/tip_filter.hpp), and the jerk of planned moves; all > 0.
struct TipLimits {
  double speed_m_s = 0.0;
  double accel_m_s2 = 0.0;
  double jerk_m_s3 = 0.0;
  double rate_rad_s = 0.0;
  double angular_accel_rad_s2 = 0.0;
  double angular_jerk_rad_s3 = 0.0;
};

// One joint drive with an absolute encoder behind the gear: counts are known from power-up on.
struct DriveParams {
  double rad_per_count = 0.0;           // of the joint, > 0
  std::int32_t direction = 1;           // +1: counts grow with the joint angle
  std::int32_t zero_counts = 0;         // counts at joint angle 0
  double torque_per_permille_Nm = 0.0;  // at the joint, for 1 permille of rated torque
};

// The whole table. Trivially copyable; constant after the loader has checked it. Joint i is driven by drive i.
struct RobotParams {
  std::int32_t joint_count = 0;  // 6..kMaxJoints
  std::array<JointParams, kMaxJoints> joint{};
  std::array<DriveParams, kMaxJoints> drive{};
  TipLimits tip{};
  TorqueParams torque{};               // of an arm whose drives follow torques
  double servo_time_constant_s = 0.0;  // of the drives' position servos
  double tick_s = 0.0;                 // control period
  std::int32_t interval_ticks = 0;     // T_c in ticks

  constexpr std::int32_t drive_count() const { return joint_count; }
  constexpr std::size_t joints() const { return static_cast<std::size_t>(joint_count); }
};

static_assert(std::is_trivially_copyable_v<RobotParams>);

}  // namespace liana::serial
