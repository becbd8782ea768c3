#include "host/operator/simulated/hands_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/model/clearance/arm_clearance.hpp"
#include "host/operator/simulated/slit_view.hpp"

namespace liana::simulated {
namespace {

constexpr double kLook_m = 0.08;  // of way between two imagined arms
constexpr int kSides = 8;

// Two unit vectors at right angles to `v` and to each other.
std::array<Vec3, 2> across(const Vec3& v) {
  const Vec3 axis = std::fabs(v[0]) < 0.6 * norm(v) ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 1.0, 0.0};
  const Vec3 one = cross(v, axis), unit = scale(one, 1.0 / norm(one));
  const Vec3 two = cross(v, unit);
  return {unit, scale(two, 1.0 / norm(two))};
}

std::vector<Vec3> sides_of(const Vec3& v) {
  const auto [a, b] = across(v);
  std::vector<Vec3> sides;
  for (int i = 0; i < kSides; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kSides;
    sides.push_back(add(scale(a, std::cos(angle)), scale(b, std::sin(angle))));
  }
  return sides;
}

double length_beyond_node_m(const ArmObservation& seen) {
  double length_m = 0.0;
  for (std::size_t i = seen.node_point + 1; i < seen.axis_m.size(); ++i)
    length_m += norm(subtract(seen.axis_m[i], seen.axis_m[i - 1]));
  return length_m;
}

// Places for the node: straight behind the tip, and tilted to every side.
std::vector<Vec3> places_of_node(const VrGains& gains, const ArmObservation& seen, const Pose& tip_goal) {
  const Vec3 heading = rotate(tip_goal.quaternion, {1.0, 0.0, 0.0});
  const double behind_m = gains.trail * length_beyond_node_m(seen);
  std::vector<Vec3> places{subtract(tip_goal.position_m, scale(heading, behind_m))};
  for (const Vec3& side : sides_of(heading)) {
    const Vec3 back = add(scale(heading, -std::cos(gains.tilt_rad)), scale(side, std::sin(gains.tilt_rad)));
    places.push_back(add(tip_goal.position_m, scale(back, behind_m)));
  }
  return places;
}

// Half way, moved aside.
HandsGoal detour(const ArmObservation& seen, const HandsGoal& goal, const Vec3& aside_m) {
  const PoseStep turn = step_between(seen.tip, goal.tip);
  const Pose half = moved(seen.tip, {scale(turn.shift_m, 0.5), scale(turn.turn_rad, 0.5)});
  return {{add(half.position_m, aside_m), half.quaternion}, add(scale(add(seen.node_m(), goal.node_m), 0.5), aside_m)};
}

std::vector<std::vector<HandsGoal>> ways_to(const VrGains& gains, const ArmObservation& seen, const HandsGoal& goal) {
  std::vector<std::vector<HandsGoal>> ways{{goal}};
  const Vec3 ahead = subtract(goal.tip.position_m, seen.tip.position_m);
  if (norm(ahead) < gains.detour_m) return ways;
  for (const Vec3& side : sides_of(ahead)) {
    for (const double share : {0.5, 1.0})
      ways.push_back({detour(seen, goal, scale(side, share * gains.detour_m)), goal});
  }
  return ways;
}

double length_m(const ArmObservation& seen, const std::vector<HandsGoal>& way) {
  double length = 0.0;
  Vec3 tip = seen.tip.position_m, node = seen.node_m();
  for (const HandsGoal& goal : way) {
    length += norm(subtract(goal.tip.position_m, tip)) + norm(subtract(goal.node_m, node));
    tip = goal.tip.position_m, node = goal.node_m;
  }
  return length;
}

}  // namespace

std::vector<Vec3> imagined_axis(const ArmObservation& seen, const Vec3& tip_shift_m, const Vec3& node_shift_m) {
  std::vector<Vec3> axis = seen.axis_m;
  const auto part = [](std::size_t i, std::size_t from, std::size_t to) {
    return to > from ? static_cast<double>(i - from) / static_cast<double>(to - from) : 1.0;
  };
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const bool beyond = i > seen.node_point;
    const double share = beyond ? part(i, seen.node_point, axis.size() - 1) : part(i, 0, seen.node_point);
    const Vec3 from = beyond ? node_shift_m : Vec3{}, to = beyond ? tip_shift_m : node_shift_m;
    axis[i] = add(axis[i], add(from, scale(subtract(to, from), share)));
  }
  return axis;
}

double imagined_room_m(const ArmObservation& seen, const config::SceneConfig& drawing,
                       const std::vector<HandsGoal>& way, double within_m) {
  double room_m = clearance::kNoObstacle_m, gone_m = 0.0;
  Vec3 tip{}, node{};  // moved so far
  for (const HandsGoal& goal : way) {
    const Vec3 tip_on = subtract(subtract(goal.tip.position_m, seen.tip.position_m), tip);
    const Vec3 node_on = subtract(subtract(goal.node_m, seen.node_m()), node);
    const double on_m = std::max(norm(tip_on), norm(node_on));
    const int looks = 1 + static_cast<int>(on_m / kLook_m);
    for (int i = 1; i <= looks && gone_m < within_m; ++i) {
      const double share = static_cast<double>(i) / looks;
      const auto axis = imagined_axis(seen, add(tip, scale(tip_on, share)), add(node, scale(node_on, share)));
      room_m = std::min(room_m, clearance::arm_clearance(axis, seen.radius_m, drawing).distance_m());
      gone_m += on_m / looks;
    }
    tip = add(tip, tip_on), node = add(node, node_on);
  }
  return room_m;
}

std::vector<HandsGoal> plan_hands(const VrGains& gains, const ArmObservation& seen, const config::SceneConfig& drawing,
                                  const Pose& tip_goal) {
  std::vector<HandsGoal> best;
  double most = -1e9;
  for (const Vec3& node_m : places_of_node(gains, seen, tip_goal)) {
    for (const auto& way : ways_to(gains, seen, {tip_goal, node_m})) {
      const double room_m = std::min(imagined_room_m(seen, drawing, way), gains.comfortable_m);
      const double worth = room_m - gains.way_price * length_m(seen, way);
      if (worth <= most) continue;
      most = worth;
      best = way;
    }
  }
  return best;
}

}  // namespace liana::simulated
