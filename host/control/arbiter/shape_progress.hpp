// How much of the wanted shape is missing, and whether it still comes nearer: what tells that a shape has arrived, long
// before the arm has come to rest altogether.
#pragma once

#include <cstddef>
#include <vector>

#include "firmware_like/cable_controller.hpp"

namespace liana::arbiter {

// The shape has settled when what is missing has not changed by more than this for this long (arm time).
constexpr double kShapeSettled_m = 0.0005;
constexpr double kShapeSettled_s = 4.0;

class ShapeProgress {
 public:
  explicit ShapeProgress(const cable::RobotParams& table);

  // One command interval of the arm and what its shape is asked for. Cost: one forward kinematics where something is
  // asked for.
  void note(const cable::Outputs& now, const cable::NodeTargets& nodes, const cable::KeepClearTargets& clear);
  // New targets: what was missing of the old ones says nothing about them.
  void restart() { recent_m_.clear(), oldest_ = 0; }

  // Sum of weight times excess, over the largest weight [m]: how far nodes are beyond their thresholds, and what points
  // to keep clear of lack. 0 when nothing is asked for.
  double missing_m() const { return missing_m_; }
  // Nothing is missing, or nothing has been gained for kShapeSettled_s.
  bool is_settled() const;

 private:
  cable::RobotParams table_;
  std::size_t window_;            // intervals in kShapeSettled_s
  std::size_t oldest_ = 0;        // place in recent_m_ that the next interval takes
  std::vector<double> recent_m_;  // missing_m of the last intervals, at most window_
  double missing_m_ = 0.0;
};

}  // namespace liana::arbiter
