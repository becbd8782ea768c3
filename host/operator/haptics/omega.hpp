// A simulated Omega.6 in a simulated hand: a delta that pushes, a wrist that is only sensed, and a loop of 1 kHz that
// samples and holds.
#pragma once

#include <cstdint>

#include "firmware_like/math/trig.hpp"
#include "host/api/device/sample.hpp"
#include "host/control/virtual_fixtures/hand_motion.hpp"
#include "host/operator/haptics/delta.hpp"
#include "host/operator/haptics/hand.hpp"

namespace liana::haptics {

// Published by Force Dimension for the omega.6: workspace, wrist, force, resolution. Assumed: everything else.
struct OmegaTable {
  DeltaTable delta{0.04, 0.14, 0.20};  // assumed: reaches the workspace, condition of the Jacobian below 1.4 in it
  double centre_m = 0.16;              // assumed: the workspace's middle, along x from the delta's base
  double radius_m = 0.080;             // published: 160 mm across, in y and z
  double depth_m = 0.055;              // published: 110 mm along x, half of it
  Vec3 wrist_rad{120.0 * kDegree, 70.0 * kDegree, 160.0 * kDegree};  // published: 240 x 140 x 320 deg, halves
  double force_N = 12.0;                                             // published
  double encoder_rad = 6e-5;   // assumed: makes the published 0.01 mm at the platform
  double mass_kg = 0.25;       // assumed: felt at the platform, gravity compensated
  double damping_N_s_m = 0.5;  // assumed
  double stop_N_m = 20000.0;   // assumed: rubber at the workspace's end
  double stop_N_s_m = 40.0;    // assumed
};

// Positions are from the workspace's middle. Deterministic, no heap.
class HeldOmega {
 public:
  // Starts at rest at `start_m`, within the workspace.
  HeldOmega(const OmegaTable& omega, const HandParams& hand, const Vec3& start_m, std::uint64_t seed);

  // One millisecond: the motors hold a force, at most what they can; the hand goes after its intent.
  void step(const Vec3& force_N, const Intent& intent) noexcept;
  // What the device tells now: position by its encoders, attitude by its wrist, the button.
  device::Sample sample() noexcept;

  // What nobody but a test can know.
  const Motion& truth() const { return truth_; }
  // Joint torques [N m] of the last step.
  const std::array<double, 3>& torques_Nm() const { return torques_Nm_; }
  // Energy [J] that the motors have taken from the hand so far, exact; negative: given to it.
  double absorbed_J() const { return absorbed_J_; }

 private:
  Vec3 stop_force() const noexcept;
  void integrate(const Vec3& motors_N, double step_s) noexcept;

  OmegaTable table_;
  Hand hand_;
  Motion truth_;
  Vec3 wrist_rad_{};
  Vec3 sensed_m_;
  std::array<double, 3> torques_Nm_{};
  double absorbed_J_ = 0.0;
  std::int64_t t_us_ = 0;
};

}  // namespace liana::haptics
