// How far a tip is from its goal, and what became of the goal: the words that the IK of every kind of arm speaks.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/math/pose.hpp"

namespace liana {

// What became of the goal. The way out of the last three is a goal back along minus the residual; the arm follows it at
// once.
enum class IkOutcome : std::uint8_t {
  kConverged = 0,    // position and attitude within the IK's tolerance
  kApproaching = 1,  // not there yet, the error more than halves per tick
  kLimited = 2,      // joint angles on their limits keep the tip away
  kSingular = 3,     // no free joint moves the tip towards the goal: straight or folded
  kUnreachable = 4,  // the goal is farther from the base than the arm is long
};
const char* ik_outcome_name(IkOutcome outcome) noexcept;

// Tip error (position [m], rotation vector [rad]) of `tip` against `goal`, base frame.
std::array<double, 6> pose_error(const Pose& goal, const Pose& tip) noexcept;

}  // namespace liana
