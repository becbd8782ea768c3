#include "host/operator/terminal/jog.hpp"

#include <algorithm>

namespace liana::terminal {
namespace {

constexpr double kLead_s = 0.3;
constexpr double kFarthestStep_s = 0.1;  // a terminal that stood still does not jump

double turn_between(const Pose& a, const Pose& b) {
  return norm(rotation_vector(multiply(a.quaternion, conjugate(b.quaternion))));
}

double way_between(const Pose& a, const Pose& b) { return norm(subtract(a.position_m, b.position_m)); }

void add_to(Vec3& sum, const Vec3& more) {
  for (std::size_t i = 0; i < 3; ++i) sum[i] = std::clamp(sum[i] + more[i], -1.0, 1.0);
}

}  // namespace

Pose next_goal(const Pose& goal, const Pose& commanded, const Direction& direction, const JogSpeed& speed,
               double passed_s, const JogLimits& limits) {
  const double step_s = std::min(passed_s, kFarthestStep_s);
  const Vec3 way_m = scale(direction.way, speed.tip_m_s * step_s);
  const Quat turn = quaternion_of(scale(direction.turn, speed.turn_rad_s * step_s));
  Pose next = goal;
  next.position_m = add(goal.position_m, speed.in_tip ? rotate(goal.quaternion, way_m) : way_m);
  next.quaternion = normalize(speed.in_tip ? multiply(goal.quaternion, turn) : multiply(turn, goal.quaternion));
  const double lead_m = way_between(next, commanded), lead_rad = turn_between(next, commanded);
  const bool too_far = lead_m > kLead_s * limits.tip_m_s && lead_m > way_between(goal, commanded);
  const bool too_turned = lead_rad > kLead_s * limits.turn_rad_s && lead_rad > turn_between(goal, commanded);
  return too_far || too_turned ? goal : next;
}

void HeldKeys::press(const Key& jog, double now_s) {
  const auto end = held_.begin() + static_cast<std::ptrdiff_t>(count_);
  auto place = std::find_if(held_.begin(), end, [&](const Held& held) { return held.key.name == jog.name; });
  if (place == end) {
    if (count_ == held_.size()) return;
    ++count_;
  }
  *place = {jog, now_s + kCounts_s};
}

bool HeldKeys::any(double now_s) const {
  return std::any_of(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(count_),
                     [now_s](const Held& held) { return held.until_s > now_s; });
}

Direction HeldKeys::direction(double now_s) const {
  Direction sum;
  for (std::size_t i = 0; i < count_; ++i) {
    if (held_[i].until_s <= now_s) continue;
    add_to(sum.way, held_[i].key.direction.way);
    add_to(sum.turn, held_[i].key.direction.turn);
  }
  return sum;
}

}  // namespace liana::terminal
