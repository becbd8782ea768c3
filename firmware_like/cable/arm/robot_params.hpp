// The robot as the core sees it: plain numbers, checked once by the loader, constant afterwards.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <type_traits>

#include "firmware_like/drive/drive_io.hpp"
#include "firmware_like/math/pose.hpp"

namespace liana::cable {

// Compiled capacity. A robot within it needs a new table and no new code.
constexpr std::int32_t kMaxSegments = 8;
constexpr std::int32_t kMaxModules = 16;       // per segment
constexpr std::int32_t kMaxSegmentCables = 5;  // per segment
constexpr std::int32_t kMaxTheta = 2 * kMaxSegments;
constexpr std::int32_t kMaxCables = kMaxDrives;

using ThetaVector = std::array<double, kMaxTheta>;   // pitch, yaw per segment [rad]; slide, roll of a base that feeds
using CableVector = std::array<double, kMaxCables>;  // segment 1 cable 0, 1, 2, segment 2 cable 0, ...

// One segment: `modules` universal joints bent by the same two angles. The first one may be a base that feeds: without
// modules, a slide along x and then a roll about x, each moved by a drive of its own in place of cables. Both are
// angles like others: the slide stands at slide_m_rad times its angle, and a drive's "cable" is the slide's way, or the
// belt that turns the roll, which nothing stretches and whose tension nobody plans.
struct SegmentParams {
  std::int32_t modules = 0;                // 1..kMaxModules; joint order alternates Rz Ry, Ry Rz; 0: a base that feeds
  std::int32_t cables = 0;                 // 3..kMaxSegmentCables; 2 drives of a base that feeds
  double module_length_m = 0.0;            // link length l
  double theta_limit_rad = 0.0;            // |theta| of both axes
  double module_mass_kg = 0.0;             // of a base that feeds: the carriage, which no cable carries
  double module_center = 0.5;              // centre of mass along a module, of its length from the root's side
  double joint_stiffness_Nm_rad = 0.0;     // of one joint, about both of its axes: backbone or spring
  std::array<double, 2> joint_rest_rad{};  // pitch and yaw of one joint at which it gives no torque
  std::array<double, kMaxSegmentCables> cable_phase_rad{};  // angle of the hole from the pitch axis' y, see cables.hpp
  double hole_radius_m = 0.0;  // of the cables that end in this segment, in every disc that they pass
  double face_offset_m = 0.0;  // disc faces before and after a joint centre of this segment
  double slide_m_rad = 0.0;    // of a base that feeds: way of its slide; 0: it bends
  double roll_radius_m = 0.0;  // and radius of the wheel that its belt turns
};

inline constexpr bool feeds(const SegmentParams& segment) noexcept { return segment.slide_m_rad > 0.0; }

// What the drives of slide and roll move for each radian of theirs.
inline constexpr std::array<double, 2> feed_m_rad(const SegmentParams& base) noexcept {
  return {base.slide_m_rad, base.roll_radius_m};
}

// Tension limits of the robot, newtons (mission, A9).
struct TensionLimits {
  double plan_N = 0.0;            // what the plan aims at
  double floor_motor_N = 0.0;     // least at the motor
  double floor_anywhere_N = 0.0;  // least anywhere along a cable
  double ceiling_free_N = 0.0;    // most in free motion
  double alarm_N = 0.0;
  double hard_limit_N = 0.0;

  // Constants of the tension plan were found on an arm that plans 40 N; another arm's are in proportion. Exactly 1
  // there.
  double scale() const noexcept { return plan_N / 40.0; }
};

// A point mass at the tip: the tool, or what it carries.
constexpr double kMaxTipLoad_kg = 100.0;
constexpr double kMaxTipLoad_m = 1.0;  // of its centre from the tip, along each axis
struct TipLoad {
  double mass_kg = 0.0;
  Vec3 center_in_tip_m{};
};

// How well cables have to agree with what is known about them (docs/explanation/fault-detection.md). The defaults fit
// readings of 0.6 N and 0.3 %.
struct CableMonitorParams {
  double jump_N = 7.0;  // most that tension may change in a tick without length or planned pose to explain it
  double contradiction_m = 100e-6;  // most that a segment's lengths may come to contradict each other, without friction
};

// How well drives know where torque is zero: deviations of each drive's reading, as tension. They count in how sure a
// force is (docs/explanation/contact-force.md); the defaults say that nobody has measured them.
struct TorqueZeroTable {
  double bias_N = 0.0;
  double drift_N_h = 0.0;  // for every hour since the controller was started
};

// Load cells between drums and first discs; a cable without one has 0 newtons per step.
struct LoadCellParams {
  CableVector newtons_per_step{};  // of a reading
  CableVector zero_N{};            // what the cell says without tension
  double range_N = 0.0;            // readings beyond count as none
  double agree_N = 0.0;            // most by which cell and torque may differ
  std::uint8_t goes_on = 0;        // 1: an arm whose cell is lost goes on by the drive's torque; 0: fault 5010
};

// Motion limits; the gate and verification enforce them, the filter and limiter plan with them.
struct MotionLimits {
  double theta_rate_rad_s = 0.0;
  double theta_accel_rad_s2 = 0.0;
  double tip_speed_m_s = 0.0;
  double tip_speed_slit_m_s = 0.0;
  double tip_accel_m_s2 = 0.0;
  double tip_jerk_m_s3 = 0.0;
  double tip_rate_rad_s = 0.0;
  double tip_angular_accel_rad_s2 = 0.0;
  double tip_angular_jerk_rad_s3 = 0.0;
  double cable_speed_m_s = 0.0;
  double tip_lag_s = 0.0;  // of the tip filter behind a steady target; 0: speed limit in force / acceleration
};

// One cable drive; see docs/reference/drives.md for the length convention.
struct DriveParams {
  double metres_per_count = 0.0;      // 2 pi drum_radius / (counts_per_turn gear), > 0
  std::int32_t direction = 1;         // +1: counts grow while cable is paid out
  std::int32_t zero_counts = 0;       // counts at payout = path_at_zero_pose + lead
  double newtons_per_permille = 0.0;  // cable tension at 1 permille of rated torque
};

// The whole table. Trivially copyable; constant after the loader has checked it.
struct RobotParams {
  std::int32_t segment_count = 0;
  std::array<SegmentParams, kMaxSegments> segment{};
  double cable_EA_N = 0.0;
  double lead_m = 0.0;       // free cable between drum and first disc
  double friction_mu = 0.0;  // capstan coefficient the core is told
  double servo_time_constant_s = 0.0;
  double tick_s = 0.0;              // control period
  std::int32_t interval_ticks = 0;  // T_c in ticks
  Vec3 gravity_m_s2{};              // in the base frame; zero: in orbit, or a rig takes the weight off
  TipLoad tool{};
  TensionLimits tension{};
  CableMonitorParams cable_monitor{};
  TorqueZeroTable torque_zero{};
  LoadCellParams load_cell{};
  std::uint32_t no_torque = 0;  // bit i: the drive of cable i reports no torque; without a cell the plan is its tension
  MotionLimits limits{};
  std::array<DriveParams, kMaxCables> drive{};

  // Number of reduced joint angles: two per segment.
  constexpr std::int32_t theta_count() const { return 2 * segment_count; }
  // Number of cables over all segments; equals the number of drives.
  constexpr std::int32_t cable_count() const {
    std::int32_t count = 0;
    for (std::int32_t m = 0; m < segment_count; ++m) count += segment[static_cast<std::size_t>(m)].cables;
    return count;
  }
  // Thetas, and drives, of a base that feeds, which come before all others: 2, or 0 where the arm's base is fixed.
  constexpr std::int32_t feed_count() const { return segment_count > 0 && feeds(segment[0]) ? 2 : 0; }
  // The first segment that bends: 1 after a base that feeds, else 0.
  constexpr std::int32_t first_bending() const { return feed_count() / 2; }
  // Number of drives: one a cable.
  constexpr std::int32_t drive_count() const { return cable_count(); }
};

static_assert(std::is_trivially_copyable_v<RobotParams>);

// The part that is cables': without drives of a base that feeds, and what lies beyond the table's.
inline std::span<const double> of_cables(const RobotParams& table, const CableVector& all) noexcept {
  const auto first = static_cast<std::size_t>(table.feed_count());
  return {all.data() + first, static_cast<std::size_t>(table.cable_count()) - first};
}

}  // namespace liana::cable
