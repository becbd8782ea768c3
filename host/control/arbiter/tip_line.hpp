// A way of moving: the tip along a straight line, turning about one axis, on one time law.
#pragma once

#include "host/control/arbiter/another_try.hpp"
#include "host/control/arbiter/arm_traits.hpp"
#include "host/control/timing/trajectory_timing.hpp"

namespace liana::arbiter {

// The line itself; the same for every arm.
class TipLine {
 public:
  // Within the bounds, and the tip not faster than `speed_m_s`.
  TipLine(const TipBounds& bounds, const Pose& from, const Pose& to, double speed_m_s,
          const motion::Swings& swings = {});
  double duration_s() const { return law_.duration_s(); }
  Pose at(double time_s) const;

 private:
  Pose from_, to_;
  Vec3 turn_rad_{};
  motion::TrajectoryTiming law_;
};

// Over when the time is up; what then stays the goal is the line's end. What was refused goes on from rest, straight to
// the end and more slowly.
template <class Arm>
class LineMove {
 public:
  static constexpr bool kIsPlanned = true;

  LineMove(const typename Arm::Table& table, const Pose& from, const Pose& to, double speed_m_s,
           const motion::Swings& swings)
      : bounds_(ArmTraits<Arm>::tip_bounds(table)),
        speed_m_s_(speed_m_s),
        swings_(swings),
        line_(bounds_, from, to, speed_m_s, swings),
        interval_s_(interval_s(table)) {}

  Pose end() const { return line_.at(line_.duration_s()); }

  Goal<Arm> next(const liana::Outputs<Arm>& now) {
    if (again_.waits(now.at_rest != 0)) return {};
    if (again_.begins_again()) {
      line_ = TipLine(bounds_, now.tip_command, end(), speed_m_s_ * again_.speed_share(), swings_);
      time_s_ = 0.0;
    }
    return line_.at(time_s_ += interval_s_);
  }
  bool is_over() const { return time_s_ >= line_.duration_s(); }
  bool refused() { return again_.refused(); }

 private:
  TipBounds bounds_;
  double speed_m_s_;
  motion::Swings swings_;
  TipLine line_;
  double interval_s_;
  double time_s_ = 0.0;
  AnotherTry again_;
};

}  // namespace liana::arbiter
