// The way out of a tight place: the arm drawn back along its own line.
//
// Follow-the-leader backwards: the tip goes to where a point of the arm's axis, ever farther behind the tip, was, with
// that point's direction; the rest of the arm takes up the length, clear of everything. What has been drawn out so is
// the way in when read backwards.
#pragma once

#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

constexpr double kRetractStep_m = 0.02;  // of the tip
constexpr double kOutside_m = 0.08;      // clearance at which the arm counts as out
constexpr double kRetractShare = 0.75;   // of the arm's length, at most

// Poses from theta (first) outwards, each with at least `margin_m`; ends when the arm is out or cannot go on. Holds the
// thetas of the mask.
Path retract(const Room& room, const ThetaVector& theta_rad, std::uint32_t held_mask, double margin_m);

}  // namespace liana::planner
