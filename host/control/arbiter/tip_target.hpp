// A way of moving: the tip goes to a pose as the core's filter takes it there, and the pose is asked for until all has
// come to be; then nothing more is, and the null space comes to rest. For streams of goals, for steering by hand, and
// for staying where a line has ended. What was refused is tried again from rest.
#pragma once

#include <cstdint>

#include "host/control/arbiter/another_try.hpp"
#include "host/control/arbiter/arm_traits.hpp"

namespace liana::arbiter {

// A tip goal counts as reached within these, some intervals after it was set: a request needs two to show in the arm's
// report.
constexpr double kArrived_m = 1e-5;
constexpr double kArrived_rad = 1e-5;
constexpr std::int32_t kSettledIntervals = 10;

template <class Arm>
class TipTarget {
 public:
  static constexpr bool kIsPlanned = false;
  using Wishes = typename ArmTraits<Arm>::Wishes;

  // `wishes` has to outlive this. `is_distant`: the goal was set far ahead at once.
  TipTarget(const Pose& goal, const Wishes& wishes, bool is_distant = false)
      : goal_(goal), wishes_(wishes), is_distant_(is_distant) {}

  const Pose& goal() const { return goal_; }
  // Something else was asked for besides the tip.
  void ask_anew() { intervals_ = 0; }

  Goal<Arm> next(const liana::Outputs<Arm>& now) {
    if (again_.waits(now.at_rest != 0)) return {};
    is_over_ = intervals_ >= kSettledIntervals && ArmTraits<Arm>::has_arrived(wishes_, now, is_near(now.tip_command));
    ++intervals_;
    return is_over_ ? Goal<Arm>{} : goal_;
  }
  bool is_over() const { return is_over_; }
  bool is_distant() const { return is_distant_; }
  bool refused() {
    intervals_ = 0;
    return again_.refused();
  }
  double speed_share() const { return again_.speed_share(); }

 private:
  bool is_near(const Pose& tip) const {
    const Vec3 turn = rotation_vector(multiply(goal_.quaternion, conjugate(tip.quaternion)));
    return norm(subtract(goal_.position_m, tip.position_m)) < kArrived_m && norm(turn) < kArrived_rad;
  }

  Pose goal_;
  const Wishes& wishes_;
  std::int32_t intervals_ = 0;  // since the goal or what is wished besides was set
  bool is_distant_;
  bool is_over_ = false;
  AnotherTry again_;
};

}  // namespace liana::arbiter
