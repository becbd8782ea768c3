// One pin of the adapter in its funnel and hole: forces written out, not an engine's contacts
// (docs/explanation/payload.md says why).
#pragma once

#include <optional>

#include "hil/math/vec3.hpp"

namespace liana::bench {

// Assumed: the source says nothing of its adapter but what it holds and how deep it goes.
struct AdapterParams {
  double circle_m = 0.25;   // radius on which the pins stand
  double body_m = 0.10;     // radius of the socket's body about each hole: beside it there is nothing to meet
  double funnel_m = 0.030;  // radial clearance at its mouth; it narrows at 45 deg
  double entry_m = 0.003;   // radial clearance at the socket's face, where the hole begins
  double full_m = 0.0003;   // and from `depth_m` on
  double depth_m = 0.020;
  double stiffness_N_m = 2e4;   // of a pin against the wall, radial
  double damping_Ns_m = 200.0;  // of it, and at the stop
  double friction = 0.15;
  double spring_N_m = 900.0;  // of the capture spring, shared by the pins as its friction and damping
  double spring_friction_N = 4.0;
  double spring_damping_Ns_m = 100.0;
  double stop_m = 0.022;
  double stop_N_m = 1e5;    // shared by the pins
  double latch_N_m = 3e4;   // of each pin, once captured
  double latch_s = 0.05;    // from the capture until the latch is closed
  double lock_m = 0.003;    // by which the lock drive draws the latched pins in
  double lock_m_s = 0.001;  // how fast
  double give_up_s = 0.5;   // so long after it should have ended, a latch or lock that has not moved on has failed
};

// What is wrong with one pin: faults from outside.
struct PinDefects {
  std::optional<double> blocked_m;  // something lies in the hole, at this depth
  std::optional<double> reads_m;    // its sensor says this whatever the depth
};

// Position and velocity of the pin's tip in the frame of its hole: z into the socket, from its face; x and y from the
// hole's middle.
struct PinState {
  Vec3 at_m;
  Vec3 velocity_m_s;
};

// Radial clearance [m] at a depth [m], from the funnel's mouth on, and how it changes with depth.
struct PinClearance {
  double radius_m;
  double slope;
};
PinClearance clearance_at(const AdapterParams& figures, double depth_m);

// Whether the socket's body is before or about the pin at all.
bool is_over_body(const AdapterParams& figures, const PinState& pin);

// Wall, face beside the funnel, spring, stop and what lies in the hole, on the pin [N].
Vec3 pin_force_N(const AdapterParams& figures, const PinDefects& defects, const PinState& pin);

// Of the latch that closed when the pin was at `closed_m` [N, along z].
double latch_force_N(const AdapterParams& figures, double closed_m, const PinState& pin);

}  // namespace liana::bench
