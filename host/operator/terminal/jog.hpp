// Where a jogged tip is asked to be: a goal that runs ahead of the commanded tip, never farther than it comes soon.
#pragma once

#include <array>

#include "host/operator/terminal/keys.hpp"

namespace liana::terminal {

struct JogSpeed {
  double tip_m_s = 0.03;
  double turn_rad_s = 0.1;
  bool in_tip = false;  // along the tip's own axes; else the base's
};

// Of the robot's table: tip_speed_m_s and tip_rate_deg_s of `limits`.
struct JogLimits {
  double tip_m_s = 0.1;
  double turn_rad_s = 0.2;
};

// The next goal of the stream: `goal` moved on by `passed_s` of the wanted velocity. It waits where it would lead
// `commanded` by more than 0.3 s of the robot's limits: lianad refuses what is farther ahead than 0.5 s.
Pose next_goal(const Pose& goal, const Pose& commanded, const Direction& direction, const JogSpeed& speed,
               double passed_s, const JogLimits& limits);

// Keys of a terminal are pressed again and again while they are held, and nobody says when they are let go: each press
// counts for a while.
class HeldKeys {
 public:
  static constexpr double kCounts_s = 0.15;  // terminals repeat every 20 to 60 ms

  void press(const Key& jog, double now_s);
  void let_go() { count_ = 0; }
  bool any(double now_s) const;
  // Of all that are held, each axis -1 to 1.
  Direction direction(double now_s) const;

 private:
  struct Held {
    Key key;
    double until_s = 0.0;
  };
  std::array<Held, 12> held_{};  // as many as there are keys that jog
  std::size_t count_ = 0;
};

}  // namespace liana::terminal
