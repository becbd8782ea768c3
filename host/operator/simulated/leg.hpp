// One straight leg of an intended motion, walked with bounded speed and acceleration.
#pragma once

#include "host/operator/simulated/slit_view.hpp"

namespace liana::simulated {

// How fast a leg is walked.
struct LegPace {
  double speed_m_s = 0.0;        // > 0
  double slow_speed_m_s = 0.0;   // > 0, from slow_from_x_m on
  double slow_from_x_m = 1e9;    // x of the outer frame where the slow part begins
  double turn_rate_rad_s = 0.0;  // > 0
  double accel_m_s2 = 0.0;       // > 0
};

// From a pose to a pose in one frame: position and attitude move together, along the shortest way.
class Leg {
 public:
  Leg() = default;
  Leg(const Pose& from, const Pose& to, const LegPace& pace);

  // One step of `dt_s`; `eagerness` 0..1 scales the speed asked for (0 brakes to a stop).
  void walk(double dt_s, double eagerness);
  // Intended pose now.
  Pose pose() const;
  // Where the leg ends.
  const Pose& goal() const { return goal_; }
  // What is left to go.
  PoseStep remaining() const;
  // Part of it that is walked, 0..1.
  double share() const { return length_m_ > 0.0 ? walked_m_ / length_m_ : 1.0; }
  // Intended speed along the leg as a share of its length per second.
  double share_per_s() const { return length_m_ > 0.0 ? speed_m_s_ / length_m_ : 0.0; }
  // Whole leg.
  const PoseStep& whole() const { return whole_; }
  bool standing() const { return speed_m_s_ == 0.0; }
  bool finished() const { return walked_m_ >= length_m_; }

 private:
  double speed_limit() const;

  Pose start_{};
  Pose goal_{};
  PoseStep whole_{};
  LegPace pace_{};
  double length_m_ = 0.0;  // of the path, or what the turn is worth at the leg's speed when that takes longer
  double walked_m_ = 0.0;
  double speed_m_s_ = 0.0;
};

}  // namespace liana::simulated
