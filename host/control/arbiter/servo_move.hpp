// A way of moving: as a visual servo leads the tip, until the servo ends.
#pragma once

#include "host/control/arbiter/arm_traits.hpp"
#include "host/control/visual_servo/target_servo.hpp"

namespace liana::arbiter {

template <class Arm>
class ServoMove {
 public:
  static constexpr bool kIsPlanned = true;

  // `servo` is under way, and has to outlive this.
  explicit ServoMove(visual_servo::TargetServo& servo) : servo_(servo) {}

  Goal<Arm> next(const liana::Outputs<Arm>& now) {
    const std::optional<Pose> goal = servo_.next(now.tip_command);
    return goal ? Goal<Arm>(*goal) : Goal<Arm>{};
  }
  bool is_over() const { return !servo_.is_under_way(); }
  bool refused() { return false; }

 private:
  visual_servo::TargetServo& servo_;
};

}  // namespace liana::arbiter
