#include "firmware_like/serial/setpoint.hpp"

#include "firmware_like/math/scalar.hpp"

namespace liana::serial {
namespace {

bool inside_ranges(const RobotTable& table, const JointVector& joint_rad) noexcept {
  for (std::size_t i = 0; i < table.joints(); ++i) {
    if (!(joint_rad[i] >= table.joint[i].low_rad && joint_rad[i] <= table.joint[i].high_rad))
      return false;  // NaN is outside
  }
  return true;
}

}  // namespace

bool is_usable(const RobotTable& table, const Setpoint& setpoint) noexcept {
  if (is_joint(setpoint.kind)) return inside_ranges(table, setpoint.joint_rad);
  if (setpoint.kind != CommandKind::kTip) return true;
  return is_valid(setpoint.tip_in_base) && setpoint.tip_speed_m_s > 0.0 && is_finite(setpoint.tip_speed_m_s);
}

}  // namespace liana::serial
