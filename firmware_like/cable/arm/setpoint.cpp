#include "firmware_like/cable/arm/setpoint.hpp"

#include <cmath>

#include "firmware_like/cable/arm/dither.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

bool angles_in_limits(const RobotParams& table, const Setpoint& setpoint) noexcept {
  for (std::int32_t i = 0; i < table.theta_count(); ++i) {
    const double limit = table.segment[as_index(i / 2)].theta_limit_rad;
    if (!(std::fabs(setpoint.joint_rad[as_index(i)]) <= limit + kStandsBeyond_rad)) return false;
    if (!(std::fabs(setpoint.held_rad[as_index(i)]) <= limit)) return false;
  }
  return true;
}

bool is_usable(const RobotParams& table, const NodeTarget& target) noexcept {
  if (target.node < 0 || target.node > table.segment_count) return false;
  if (!is_finite(dot(target.position_m, target.position_m))) return false;
  return target.weight >= 0.0 && is_finite(target.weight) && target.threshold_m >= 0.0;
}

bool is_usable(const KeepClear& target) noexcept {
  if (!is_finite(dot(target.centre_m, target.centre_m))) return false;
  return target.weight >= 0.0 && is_finite(target.weight) && target.distance_m >= 0.0 && is_finite(target.distance_m);
}

}  // namespace

bool is_usable(const TipLoad& load) noexcept {
  if (!(load.mass_kg >= 0.0 && load.mass_kg <= kMaxTipLoad_kg)) return false;
  for (const double center_m : load.center_in_tip_m) {
    if (!(std::fabs(center_m) <= kMaxTipLoad_m)) return false;
  }
  return true;
}

bool is_usable(const RobotParams& table, const Setpoint& setpoint) noexcept {
  if (!is_motion(setpoint.kind)) return true;
  if (is_force(setpoint.kind)) return false;  // cables have no force control
  if (!angles_in_limits(table, setpoint) || !is_usable(setpoint.payload)) return false;
  if (!(setpoint.dither_share >= 0.0 && setpoint.dither_share <= kDitherMost)) return false;
  if (is_joint(setpoint.kind)) return true;
  for (const NodeTarget& target : setpoint.node) {
    if (!is_usable(table, target)) return false;
  }
  for (const KeepClear& target : setpoint.clear) {
    if (!is_usable(target)) return false;
  }
  return is_valid(setpoint.tip_in_base) && setpoint.tip_speed_m_s > 0.0;
}

}  // namespace liana::cable
