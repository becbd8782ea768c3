#include "host/arbiter/cable_kind.hpp"

#include <algorithm>

namespace liana {

using Kind = ArmKind<cable::CableArm>;
static_assert(KnownArm<cable::CableArm>);

bool has_nodes(const cable::NodeTargets& nodes) {
  return std::any_of(nodes.begin(), nodes.end(), [](const cable::NodeTarget& target) { return target.node != 0; });
}

// Every module of the segment turns by theta; each moves what lies beyond it.
double Kind::lever_m(const cable::RobotTable& table, std::size_t theta) {
  double sum_m = 0.0, beyond_m = 0.0;
  for (std::size_t m = static_cast<std::size_t>(table.segment_count); m-- > theta / 2;) {
    const cable::SegmentTable& segment = table.segment[m];
    for (std::int32_t module = 0; module < segment.modules; ++module) {
      beyond_m += segment.module_length_m;
      if (m == theta / 2) sum_m += beyond_m;
    }
  }
  return sum_m;
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

}  // namespace liana
