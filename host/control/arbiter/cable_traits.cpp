#include "host/control/arbiter/cable_traits.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/let_go.hpp"

namespace liana::arbiter {

using Kind = ArmTraits<cable::CableArm>;
static_assert(SupportedArm<cable::CableArm>);

bool has_nodes(const cable::NodeTargets& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [](const cable::NodeTarget& target) { return target.node != 0; });
}

double Kind::apart_m(const cable::RobotParams& table, const Joints& a, const Joints& b) {
  const cable::ArmKinematics from = cable::forward_kinematics(table, a), to = cable::forward_kinematics(table, b);
  double most_m = 0.0;
  for (std::size_t node = 1; node <= static_cast<std::size_t>(table.segment_count); ++node)
    most_m = std::max(most_m, norm(subtract(to.node_in_base[node].position_m, from.node_in_base[node].position_m)));
  return most_m;
}

double Kind::drive_time_s(const cable::RobotParams& table, const Joints& a, const Joints& b) {
  const cable::CableLayout layout = cable::cable_layout(table);
  const auto from = cable::cable_geometry(table, layout, cable::arm_trig(table, a)).length_m;
  const auto to = cable::cable_geometry(table, layout, cable::arm_trig(table, b)).length_m;
  double most_m = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout.cable_count); ++i)
    most_m = std::max(most_m, std::fabs(to[i] - from[i]));
  return most_m / table.limits.cable_speed_m_s;
}

bool Kind::recovers(const cable::RobotParams& table, const liana::Outputs<cable::CableArm>& now) {
  if (now.state != OperatingState::kEnabled) return false;
  for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c)
    if (cable::is_planned_released(table, now.tension_plan_N, c)) return true;
  return false;
}

void Kind::add_wishes(const Wishes& wishes, cable::Setpoint& setpoint) {
  setpoint.held_mask = wishes.held_mask;
  setpoint.held_rad = wishes.held_rad;
  setpoint.node = wishes.nodes;
  setpoint.clear = wishes.clear;
}

bool Kind::has_arrived(const Wishes& wishes, const liana::Outputs<cable::CableArm>& now, bool tip_there) {
  if (now.held_at_target == 0) return false;
  const bool shape_wanted = has_nodes(wishes.nodes) || cable::largest_weight(wishes.clear) > 0.0;
  return shape_wanted ? now.at_rest != 0 : tip_there;
}

}  // namespace liana::arbiter
