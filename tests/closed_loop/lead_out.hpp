// An arm whose cable breaks, led back along the path it came by as `liana recover` does it: on the cables that are
// left.
#pragma once

#include <cstddef>
#include <vector>

#include "arm_under_control.hpp"

namespace liana::closed_loop {

// What came of it, by the truth.
struct LeadOut {
  bool is_back = false;         // all the way, under power
  int fault = 0;                // the last one latched on the way; 0: none
  std::size_t points_left = 0;  // of the path
  double enable_s = 0.0, seconds = 0.0;
  double contact_N = 0.0;    // largest on the way back
  double max_motor_N = 0.0;  // pulled hardest
  double off_deg = 0.0;      // largest of any true angle from its command
};

// Commanded angles, one row for each command interval; the arm stands at the last one.
using Path = std::vector<cable::ThetaVector>;

// Breaks the cable, waits until the arm stands in FAULT, clears for the way back, enables and leads back.
LeadOut break_and_lead_out(ArmUnderControl& arm, std::size_t cable, const Path& path);

}  // namespace liana::closed_loop
