#include "host/daemon/shape_progress.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/motion/keep_clear.hpp"

namespace liana {
namespace {

double missing_now_m(const RobotTable& table, const Outputs& now, const NodeTargets& nodes, const KeepClearTargets& clear) {
  double largest = largest_weight(clear);
  double sum_m =
      largest > 0.0 ? missing_clearance_m(table, now.theta_command_rad, forward_kinematics(table, now.theta_command_rad), clear) : 0.0;
  for (const NodeTarget& target : nodes) {
    if (target.node == 0) continue;
    const Vec3& node_m = now.node_command_m[static_cast<std::size_t>(target.node - 1)];
    sum_m += target.weight * std::max(0.0, norm(subtract(target.position_m, node_m)) - target.threshold_m);
    largest = std::max(largest, target.weight);
  }
  return largest > 0.0 ? sum_m / largest : 0.0;
}

}  // namespace

ShapeProgress::ShapeProgress(const RobotTable& table)
    : table_(table), window_(static_cast<std::size_t>(std::ceil(kShapeSettled_s / (table.tick_s * table.interval_ticks)))) {}

void ShapeProgress::note(const Outputs& now, const NodeTargets& nodes, const KeepClearTargets& clear) {
  missing_m_ = missing_now_m(table_, now, nodes, clear);
  if (recent_m_.size() < window_) {
    recent_m_.push_back(missing_m_);
    return;
  }
  recent_m_[oldest_] = missing_m_;
  oldest_ = (oldest_ + 1) % window_;
}

bool ShapeProgress::is_settled() const {
  if (missing_m_ == 0.0) return true;
  if (recent_m_.size() < window_) return false;
  const auto [least, most] = std::minmax_element(recent_m_.begin(), recent_m_.end());
  return *most - *least < kShapeSettled_m;
}

}  // namespace liana
