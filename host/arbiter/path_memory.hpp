// What the arm was commanded after verification, one point per command interval in which it moved.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>

namespace liana::arbiter {

template <class Joints>
class PathMemory {
 public:
  // Notes where the command stands at `tick`; points closer than 1e-7 rad to the last one are left out.
  void note(std::uint64_t tick, const Joints& joint_rad) {
    if (!points_.empty() && largest_change(joint_rad, points_.back().joint_rad) < kSamePoint_rad) return;
    points_.push_back({tick, joint_rad});
    if (points_.size() > kMaxPathPoints) points_.pop_front();
  }
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }
  // Takes the newest point off; nothing when it is older than `until_tick` or none is left.
  std::optional<Joints> step_back(std::uint64_t until_tick) {
    if (points_.empty() || points_.back().tick < until_tick) return std::nullopt;
    const Joints joint_rad = points_.back().joint_rad;
    points_.pop_back();
    return joint_rad;
  }

 private:
  static constexpr std::size_t kMaxPathPoints = 500000;  // 2.7 h of motion at 50 Hz; the oldest go first
  static constexpr double kSamePoint_rad = 1e-7;

  struct Point {
    std::uint64_t tick;
    Joints joint_rad;
  };

  static double largest_change(const Joints& a, const Joints& b) {
    double change = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) change = std::max(change, std::fabs(a[i] - b[i]));
    return change;
  }

  std::deque<Point> points_;
};

}  // namespace liana::arbiter
