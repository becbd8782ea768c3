// One push of a payload into its adapter by the real Controller, and what it is judged by.
#pragma once

#include <cstdint>

#include "tests/serial/force_rig.hpp"

namespace liana::test {

struct PushRun {
  double captured_s = -1.0;  // after it began; < 0: not captured
  double peak_N = 0.0;       // of the contact, along the axis
  double peak_Nm = 0.0;      // of any joint's gear
  double base_m = 0.0;       // the most that the base moved
  double after_1s_N = 0.0;   // at the wrist, a second after capture
  double resisted_N = 0.0;   // what had to be overcome at the capture, along the axis
  double loaded_s = 0.0;     // from the first contact until less than 5 N are left
  double set_after_N = 0.0;  // the most that is set from the capture on
  int unload_ticks = -1;     // from the message to no set force
  serial::InsertResult end = serial::InsertResult::kNot;
  std::int32_t faults = 0;
};

// What the wrist sensor feels beyond the payload's own inertia, as the controller takes it.
double given_N(const serial::Outputs& out);

// Enables the arm, asks for 30 N and goes on for `most_s`.
PushRun run_push(ForceRig& rig, serial::InsertLaw law, double most_s);

}  // namespace liana::test
