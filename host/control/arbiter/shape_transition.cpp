#include "host/control/arbiter/shape_transition.hpp"

#include <algorithm>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/tip_target.hpp"

namespace liana::arbiter {

namespace {

constexpr double kLed_m = 0.005;  // nodes nearer than this to the shape that was found are there

cable::NodeTargets nodes_of(const cable::RobotParams& table, const inverse_kinematics::GoalIkResult& best) {
  cable::NodeTargets out{};
  if (!best.converged) return out;
  const cable::ArmKinematics arm = cable::forward_kinematics(table, best.theta_rad);
  const std::int32_t count = std::min(table.segment_count - 1, cable::kMaxNodeTargets);
  for (std::int32_t node = 1; node <= count; ++node)
    out[static_cast<std::size_t>(node - 1)] = {node, arm.node_in_base[static_cast<std::size_t>(node)].position_m, 1.0,
                                               0.0};
  return out;
}

}  // namespace

void ShapeTransition::look_for(const inverse_kinematics::GoalIkProblem& problem) {
  forget();
  search_.start(problem);
}

void ShapeTransition::forget() {
  search_.forget();
  nodes_ = {};
}

bool ShapeTransition::leads() const { return has_nodes(nodes_); }

ShapeTransition::Found ShapeTransition::look() {
  if (!search_.is_wanted()) return Found::kNothing;
  const std::optional<inverse_kinematics::GoalIkResult> best = search_.take(taken_ == SearchResult::kInItsInterval);
  if (!best) return Found::kNotYet;
  nodes_ = nodes_of(table_, *best);
  intervals_ = 0;
  return Found::kNow;
}

bool ShapeTransition::is_there(const cable::Outputs& now) const {
  return std::all_of(nodes_.begin(), nodes_.end(), [&](const cable::NodeTarget& target) {
    if (target.node == 0) return true;
    const Vec3& node_m = now.node_command_m[static_cast<std::size_t>(target.node - 1)];
    return norm(subtract(target.position_m, node_m)) < kLed_m;
  });
}

bool ShapeTransition::ends(const cable::Outputs& now) {
  const bool settled = intervals_++ >= kSettledIntervals && now.at_rest != 0;
  if (!leads() || (!settled && !is_there(now))) return false;
  forget();
  return true;
}

}  // namespace liana::arbiter
