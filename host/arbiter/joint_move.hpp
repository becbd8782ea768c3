// A way of moving: all joints together from where they stand to a goal, on one time law.
#pragma once

#include "host/arbiter/arm_kind.hpp"
#include "host/motion/time_law.hpp"

namespace liana::arbiter {

template <class Arm>
class JointMove {
 public:
  static constexpr bool kIsPlanned = true;
  using Table = typename Arm::Table;

  // Duration such that no joint passes `rate_rad_s`, its own rate and its acceleration for moves, and the tip not its
  // speed limit. Cost: 100 forward kinematics.
  JointMove(const Table& table, const Joints<Arm>& from_rad, const Joints<Arm>& to_rad, double rate_rad_s,
            const motion::Swings& swings = {});

  double duration_s() const { return law_.duration_s(); }
  // Joints at a time since the start.
  Joints<Arm> at(double time_s) const;

  Goal<Arm> next(const liana::Outputs<Arm>& now);
  // The time is up and the arm, which follows, is at rest.
  bool is_over() const { return is_over_; }
  bool refused() { return false; }

 private:
  Joints<Arm> from_rad_, to_rad_;
  double interval_s_;
  motion::TimeLaw law_;
  double time_s_ = 0.0;
  bool is_over_ = false;
};

}  // namespace liana::arbiter
