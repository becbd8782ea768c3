// Dry friction of one joint: it sticks like a stiff spring and slides at its limit, whatever the rate.
#pragma once

#include <algorithm>
#include <cmath>

namespace liana::bench {

class CoulombFriction {
 public:
  static constexpr double kGive_rad = 1e-4;  // before it slides: assumed, far below what an encoder shows of a gear

  CoulombFriction(double max_Nm, double position_rad) : max_Nm_(max_Nm), anchor_rad_(position_rad) {}

  // Against a motion to `position_rad`; nothing is remembered.
  double torque_Nm(double position_rad) const {
    return std::clamp(-stiffness() * (position_rad - anchor_rad_), -max_Nm_, max_Nm_);
  }
  bool sticks_at(double position_rad) const { return std::fabs(position_rad - anchor_rad_) < kGive_rad; }
  double stiffness() const { return max_Nm_ / kGive_rad; }
  // The joint is there now: what is farther than the give is dragged along.
  void drag(double position_rad) {
    anchor_rad_ = std::clamp(anchor_rad_, position_rad - kGive_rad, position_rad + kGive_rad);
  }
  // Stored in the give, J.
  double energy_J(double position_rad) const {
    const double give_rad = position_rad - anchor_rad_;
    return 0.5 * stiffness() * give_rad * give_rad;
  }

 private:
  double max_Nm_;
  double anchor_rad_;
};

}  // namespace liana::bench
