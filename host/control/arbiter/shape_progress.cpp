#include "host/control/arbiter/shape_progress.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/shape/keep_clear.hpp"
#include "firmware_like/cable/shape/shape.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

double missing_now_m(const RobotParams& table, const ThetaVector& theta_rad, const NodeTargets& nodes,
                     const KeepClearTargets& clear) {
  const double largest = std::max(largest_weight(table, nodes), largest_weight(clear));
  if (!(largest > 0.0)) return 0.0;
  const ArmKinematics arm = forward_kinematics(table, theta_rad);
  return (node_excess_m(table, arm, nodes) + missing_clearance_m(table, theta_rad, arm, clear)) / largest;
}

}  // namespace

ShapeProgress::ShapeProgress(const RobotParams& table)
    : table_(table),
      window_(static_cast<std::size_t>(std::ceil(kShapeSettled_s / (table.tick_s * table.interval_ticks)))) {}

void ShapeProgress::note(const cable::Outputs& now, const NodeTargets& nodes, const KeepClearTargets& clear) {
  missing_m_ = missing_now_m(table_, now.theta_command_rad, nodes, clear);
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

}  // namespace liana::arbiter
