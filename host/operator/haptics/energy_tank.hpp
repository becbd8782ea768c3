// Passivity at the device's port: the motors never give the hand more energy than they have taken from it and the tank
// held at the start. What is kept is the energy that the device's own sensors saw, F . dx of every millisecond, with F
// as it was applied.
//
// For the millisecond to come dx is not known. It is bounded: the last one, plus what the largest acceleration adds,
// plus what the encoders do not see. A force may spend at most `share` of the store over that way, so the store falls
// like a geometric series and the hand may accelerate 1 / share times as hard as assumed before it reaches zero.
#pragma once

#include "host/control/virtual_fixtures/hand_motion.hpp"

namespace liana::haptics {

// Tanks: M. Franken et al., IEEE T-RO 27(4), 2011.
struct TankParams {
  double start_J = 0.1;      // also the most that the port can ever give beyond what it took
  double most_J = 1.0;       // what the hand brings in beyond it is forgotten
  double reserve_J = 0.002;  // never spent: what errors of the encoders may add up to (measured: 0.02 mJ in 43 s)
  double share = 0.1;        // of the store, that one millisecond may take; 0 .. 0.5
  double accel_m_s2 = 50.0;  // assumed: 12 N and a stiff hand on 0.75 kg
  double unseen_m = 2e-5;    // two steps of the encoders
  double regrow_per_s =
      10.0;  // a force that was held back comes back in 0.1 s, so that a tank at its end does not chatter
};

class EnergyTank {
 public:
  explicit EnergyTank(const TankParams& table) : table_(table), store_J_(table.start_J) {}

  // Once a millisecond, the last thing before the motors: books what the last force did on the way to `position_m`,
  // and gives back the force that may act now: `wanted_N` or a part of it.
  Vec3 pass(const Vec3& wanted_N, const Vec3& position_m) noexcept;

  double store_J() const { return store_J_; }
  // Part of the wanted force that passed, 0..1.
  double passed() const { return passed_; }

 private:
  double allowed_N(const Vec3& wanted_N, double length_N, const Vec3& moved_m) const noexcept;

  TankParams table_;
  double store_J_;
  double passed_ = 1.0;
  Vec3 force_N_{};
  Vec3 position_m_{};
  bool begun_ = false;
};

}  // namespace liana::haptics
