#include "firmware_like/cable/arm/drive_limits.hpp"

#include <cmath>

#include "firmware_like/cable/arm/let_go.hpp"
#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

// Most that its angles can change the path of cable `cable` of segment `segment` (both 0-based): no hole turns about a
// joint with a larger arm than its distance from the joint centre, and a joint turns about two axes.
double max_bend_m(const RobotParams& table, std::int32_t segment, std::int32_t cable) noexcept {
  if (const SegmentParams& base = table.segment[as_index(segment)]; feeds(base))
    return feed_m_rad(base)[as_index(cable)] * base.theta_limit_rad;
  const double radius_m = table.segment[as_index(segment)].hole_radius_m;
  double offset_m = 0.0, turn_rad = 0.0;
  for (std::int32_t m = 0; m <= segment; ++m) {
    const SegmentParams& part = table.segment[as_index(m)];
    turn_rad += 2.0 * static_cast<double>(part.modules) * part.theta_limit_rad;
    offset_m = larger(offset_m, part.face_offset_m);
  }
  return std::sqrt(radius_m * radius_m + offset_m * offset_m) * turn_rad;
}

DriveLimits limits_of(const RobotParams& table, const DriveParams& drive, double zero_payout_m,
                      double bend_m) noexcept {
  const double elongation_m = (zero_payout_m + bend_m) * table.tension.hard_limit_N / table.cable_EA_N;
  const double in_counts = counts_at_payout(drive, zero_payout_m, zero_payout_m - bend_m - elongation_m);
  const double out_counts = counts_at_payout(drive, zero_payout_m, zero_payout_m + bend_m + elongation_m);
  const double step_m = table.limits.cable_speed_m_s * table.tick_s * kTargetSpeedMargin;
  DriveLimits limits{};
  limits.min_counts = smaller(in_counts, out_counts);  // counts may grow or fall while cable is paid out
  limits.max_counts = larger(in_counts, out_counts);
  limits.step_counts =
      static_cast<std::int64_t>(to_counts(step_m / drive.metres_per_count).value) + kGateRoundingCounts;
  limits.let_go_counts =
      drive.direction *
      (static_cast<std::int64_t>(to_counts(kLetGoStep_m / drive.metres_per_count).value) + kGateRoundingCounts);
  limits.max_permille = table.tension.ceiling_free_N / drive.newtons_per_permille;
  return limits;
}

}  // namespace

GateLimits make_gate_limits(const RobotParams& table, const CableVector& zero_payout_m) noexcept {
  GateLimits limits{};
  limits.drive_count = table.drive_count();
  std::int32_t cable = 0;
  for (std::int32_t segment = 0; segment < table.segment_count; ++segment) {
    for (std::int32_t c = 0; c < table.segment[as_index(segment)].cables; ++c, ++cable) {
      const std::size_t i = as_index(cable);
      limits.drive[i] = limits_of(table, table.drive[i], zero_payout_m[i], max_bend_m(table, segment, c));
    }
  }
  return limits;
}

LinkLimits make_link_limits(const RobotParams& table) noexcept {
  LinkLimits limits{};
  limits.drive_count = table.drive_count();
  limits.heartbeat_age_ticks = heartbeat_age_ticks(table.tick_s);
  limits.patience = patience(table.tick_s);
  const double delay_s = table.servo_time_constant_s + kFollowingDeadTicks * table.tick_s;
  const double window_m = kFollowingWindow_m + kTargetSpeedMargin * table.limits.cable_speed_m_s * delay_s;
  for (std::int32_t i = 0; i < limits.drive_count; ++i) {
    limits.following_counts[as_index(i)] = to_counts(window_m / table.drive[as_index(i)].metres_per_count).value;
  }
  return limits;
}

}  // namespace liana::cable
