// A simulated person's hand on a simulated Omega.6 with its force loop: what the person wants goes in, what the device
// senses comes out. The hand gives way to the force, as a hand does.
#pragma once

#include <cstdint>

#include "host/operator/haptics/haptic_loop.hpp"
#include "host/operator/haptics/omega.hpp"

namespace liana::haptics {

// The device stands turned on its desk, its depth (x, the shorter way) across the arm's base x.
class HeldHand {
 public:
  // `hand` without a reaction time and tremor of its own when the person who wants has theirs. Throws
  // std::invalid_argument as HapticLoop does.
  HeldHand(const HandLoopTable& loop, const HandParams& hand, std::uint64_t seed);

  // One millisecond: where the person wants the hand to be (device frame parallel to the arm's base), and where the
  // hand asks the tip to be. What the device senses, with the time of the wish.
  device::Sample step(const device::Sample& wish, const Vec3& commanded_m) noexcept;

  HapticLoop& loop() { return loop_; }
  const HandForce& force() const { return force_; }
  // Largest force of the motors so far [N].
  double peak_force_N() const { return peak_force_N_; }
  // Least of the energy that the motors had taken from the hand so far, exact [J]; negative: given to it.
  double min_energy_J() const { return min_energy_J_; }

 private:
  HeldOmega omega_;
  HapticLoop loop_;
  HandForce force_{};
  double peak_force_N_ = 0.0;
  double min_energy_J_ = 0.0;
};

}  // namespace liana::haptics
