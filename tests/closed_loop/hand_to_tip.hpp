// A hand that leads the tip, and how the true tip comes after it: the arm gets its goals as late as a device's samples
// reach it through lianad.
#pragma once

#include <cstdint>
#include <string>

#include "arm_under_control.hpp"

namespace liana::closed_loop {

// From the hand to the goal in force at the end of a command interval: half an interval, because its samples are
// averaged; one in which the command is verified; one over which the core goes on to it.
constexpr double kHandToGoal_intervals = 2.5;

// Where the hand leads from, and how.
struct Led {
  std::string pose = "prepare";
  Vec3 direction{-0.6, -0.6, 0.529};  // in the base frame, length 1
  double limit_m_s = 0.10;            // of the tip
  std::uint32_t held_mask = 0;        // thetas that go to 0 and stay there
};

inline const Led kFree{};

struct Following {
  double lag_s = 0.0;  // of the true tip behind the hand at constant speed, mean over a whole swing: what it stands off
                       // counts as lag, so of the exact arm only
  double swing_mm =
      0.0;  // largest way of the true tip away from where it is commanded, beside what it stood off before
  double overshoot_mm = 0.0;  // of the true tip past the end of the way
  double least_N = 1e9;       // tension anywhere
  std::int32_t faults = 0;
};

// As the table says, without friction; and one with friction that differs from the table by `seed`.
inline PlantSetup exact_arm(const Led& led) { return {"ideal", 1, false, led.pose}; }
inline PlantSetup real_arm(const Led& led, std::uint64_t seed) { return {"nominal", seed, true, led.pose}; }

// An arm whose controller has the table's figures but for these limits.
struct ArmToLead : ArmUnderControl {
  ArmToLead(const PlantSetup& setup, const cable::MotionLimits& limits);
  // Boots, goes to the pose and comes to rest there, held variables where they belong.
  void settle(const Led& led);
};

// The hand speeds up for a second and goes on at `speed_m_s` for four.
Following follow_steadily(ArmUnderControl& arm, const Led& led, double speed_m_s);
// A reach of `way_m` in `seconds` (minimum jerk), and four seconds after it.
Following follow_reach(ArmUnderControl& arm, const Led& led, double way_m, double seconds);

}  // namespace liana::closed_loop
