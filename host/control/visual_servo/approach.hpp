// From what is left to go to the next tip goal: v = -k e, within limits of speed and acceleration, slower in time where
// it has to stop. Along the target's axis that is the way in, across it, and turning, each with limits of its own.
#pragma once

#include <cstddef>
#include <optional>

#include "firmware_like/math/pose.hpp"

namespace liana::visual_servo {

// Figures of the payload's approach, found by simulation (docs/explanation/visual-servo.md).
struct ApproachLimits {
  double gain_1_s = 0.45;            // of all three
  double speed_m_s = 0.028;          // along the way in
  double lateral_speed_m_s = 0.008;  // across it
  double rate_rad_s = 0.00873;       // 0.5 deg/s
  double accel_m_s2 = 0.005;
  double angular_accel_rad_s2 = 0.00436;  // 0.25 deg/s2
  std::size_t axis = 0;                   // of the target, 0 to 2: the way in
  double sag_tau_s = 0.0;                 // of the low-pass on how far the arm is off its command; 0: none
};

// What is left to go, in the target's axes.
struct PoseError {
  Vec3 m{};
  Vec3 rad{};
};

// The rotation vector that turns `from` into `to`, in the frame both are given in [rad].
inline Vec3 turn_between(const Quat& from, const Quat& to) { return rotation_vector(multiply(to, conjugate(from))); }

// From `tip` to `goal`, both in the base; turned into the axes of `target_in_base`.
PoseError error_between(const Pose& target_in_base, const Pose& goal, const Pose& tip);

// The greatest speed towards a goal `away` from here (>= 0): gain times it, and not more than can be braked away from.
double approach_speed(double away, double gain_1_s, double accel, double speed);

class Approach {
 public:
  explicit Approach(const ApproachLimits& limits = {}) : limits_(limits) {}

  // Starts from rest, where the tip is commanded to be.
  void begin(const Pose& tip_command) { *this = Approach(limits_, tip_command); }
  // The tip goal for the next `dt_s`: towards `goal`, and as far beyond as the arm is measured off its command. What
  // has been asked for and the command has not done yet counts as done, or its lag would turn into overshoot.
  Pose next(const Pose& target_in_base, const Pose& goal, const Pose& tip_measured, const Pose& tip_command,
            double dt_s);
  // The tip goal for the next `dt_s` while it is not known where to go: comes to rest.
  Pose brake(double dt_s);

 private:
  Approach(const ApproachLimits& limits, const Pose& tip_command) : limits_(limits), asked_(tip_command) {}
  const PoseError& follow_sag(const PoseError& sag, double dt_s);
  Pose move(const Vec3& wished_m_s, const Vec3& wished_rad_s, double dt_s);

  ApproachLimits limits_;
  Pose asked_{};
  std::optional<PoseError> sag_;  // of the arm against its command
  Vec3 velocity_m_s_{};           // base frame
  Vec3 rate_rad_s_{};             // base frame
};

}  // namespace liana::visual_servo
