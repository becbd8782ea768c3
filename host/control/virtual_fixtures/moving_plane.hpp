// A virtual wall, rendered at the device's own rate: what crosses the line to the device is a plane with stiffness and
// damping, never a force.
#pragma once

#include <cstdint>

#include "host/control/virtual_fixtures/hand_motion.hpp"

namespace liana::haptics {

// Free where normal . p >= offset_m, in the device's frame.
struct Plane {
  Vec3 normal{1.0, 0.0, 0.0};  // unit length, to the free side
  double offset_m = 0.0;
  double stiffness_N_m = 0.0;  // 0 .. 3000: 0 is no wall
  double damping_N_s_m = 0.0;  // 0 .. 30, when going in
};

// Whether every number is finite and in its range, and the normal's length 1 within 1e-6.
bool is_valid(const Plane& plane) noexcept;

// What a wall does to a hand: spring and damper while inside, never a pull. `plane_m_s`: the plane's own speed along
// its normal.
Vec3 plane_force(const Plane& plane, double plane_m_s, const Motion& hand) noexcept;

// A plane that is told every 20 ms and moves evenly in between: held, one moving at 30 mm/s would be felt as steps of
// 0.9 N (docs/explanation/force-feedback.md).
class MovingPlane {
 public:
  // A new plane, reached one interval from now; the first one, and one after none, gets its stiffness in that time.
  // False, and nothing changed, for one that is not valid.
  bool take(const Plane& plane) noexcept;
  // One millisecond on.
  void advance() noexcept;
  Vec3 force(const Motion& hand) const noexcept { return plane_force(now_, speed_m_s_, hand); }
  const Plane& now() const { return now_; }

 private:
  static constexpr int kInterval = 20;  // [ms], T_c

  Plane from_{};
  Plane to_{};
  Plane now_{};
  double speed_m_s_ = 0.0;
  int done_ = kInterval;
};

}  // namespace liana::haptics
