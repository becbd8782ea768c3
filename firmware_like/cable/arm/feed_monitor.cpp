#include "firmware_like/cable/arm/feed_monitor.hpp"

#include <cmath>

#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

double most_way_m(const RobotParams& table, std::size_t drive) noexcept {
  const double rate_m_s = feed_m_rad(table.segment[0])[drive] * table.limits.theta_rate_rad_s;
  return kFeedJumpWindow_m + rate_m_s * jump_s(table.tick_s, table.servo_time_constant_s);
}

}  // namespace

FeedReadings read_feed(const RobotParams& table, const DriveFeedbacks& drives, const CableVector& zero_payout_m,
                       const CableVector& before_m, bool heard) noexcept {
  FeedReadings now{};
  for (std::size_t i = 0; i < now.size(); ++i) {
    now[i].force_N = table.drive[i].newtons_per_permille * drives[i].torque_permille;
    const double payout_m = payout_at_counts(table.drive[i], zero_payout_m[i], drives[i].position_counts);
    now[i].jumped = heard && std::fabs(payout_m - before_m[i]) > most_way_m(table, i);
  }
  return now;
}

double carriage_load_Nm(const RobotParams& table, std::int32_t drive) noexcept {
  if (drive != 0) return 0.0;  // its middle lies on the roll's axis
  return -table.segment[0].slide_m_rad * table.segment[0].module_mass_kg * table.gravity_m_s2[0];
}

double feed_unexplained_N(const RobotParams& table, std::int32_t drive) noexcept {
  const std::size_t i = as_index(drive);
  double mass_kg = table.tool.mass_kg, reach_m = 0.0;
  for (std::size_t j = 1; j < as_index(table.segment_count); ++j) {
    const SegmentParams& segment = table.segment[j];
    mass_kg += segment.modules * segment.module_mass_kg;
    reach_m += segment.modules * segment.module_length_m;
  }
  if (drive == 0) mass_kg += table.segment[0].module_mass_kg;
  const double weight_N = mass_kg * std::sqrt(dot(table.gravity_m_s2, table.gravity_m_s2));
  const double lever = drive == 0 ? 1.0 : reach_m / table.segment[0].roll_radius_m;
  return kFeedFriction * 1000.0 * table.drive[i].newtons_per_permille + lever * (kFeedTip_N + kFeedWeight * weight_N);
}

void watch_feed(const RobotParams& table, WatchScope scope, const FeedReading& now, double load_Nm, std::int32_t drive,
                TensionMonitorState& state, Watch& out) noexcept {
  if (now.jumped) out.wrong(FaultNumber::kJointJump, drive, 0);
  const bool overload = scope.powered && std::fabs(now.force_N) > table.tension.hard_limit_N;
  out.debounced(overload, kOverloadDebounceTicks, state.overload_ticks[as_index(drive)], FaultNumber::kCableOverload,
                drive);
  std::uint16_t& ticks = state.slack_ticks[as_index(drive)];
  const double beside_N = std::fabs(now.force_N - feed_force_N(table, drive, load_Nm));
  if (!scope.prepared || ((table.no_torque >> as_index(drive)) & 1u) != 0 ||
      beside_N <= feed_unexplained_N(table, drive)) {
    ticks = 0;
    return;
  }
  if (ticks < kFeedDebounceTicks) ++ticks;
  if (ticks < kFeedDebounceTicks) return;
  const double beside_Nm = feed_m_rad(table.segment[0])[as_index(drive)] * beside_N;
  out.wrong(FaultNumber::kBodyContact, drive,
            narrow<std::uint16_t>(to_counts(smaller(100.0 * beside_Nm, 65535.0)).value));
}

}  // namespace liana::cable
