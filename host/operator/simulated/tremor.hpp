// Physiological tremor of a hand: 8 to 12 Hz, on every axis; or another motion of a band of frequencies.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/math/pose.hpp"

namespace liana::simulated {

// Three sinusoids an axis with seeded frequencies and phases; a pure function of time, so it does not depend on when it
// is asked.
class Tremor {
 public:
  // `position_m` and `rotation_rad`: RMS of each axis; `purpose` separates the hands of one seed.
  Tremor(double position_m, double rotation_rad, std::uint64_t seed, std::uint64_t purpose, double lowest_hz = 8.0,
         double highest_hz = 12.0);

  // `pose` as the trembling hand holds it at time `t_s`.
  Pose apply(const Pose& pose, double t_s) const;

 private:
  static constexpr std::size_t kWaves = 3;
  struct Wave {
    double rate_rad_s = 0.0;
    double phase_rad = 0.0;
  };
  double axis(std::size_t index, double t_s) const;

  double position_m_;
  double rotation_rad_;
  std::array<std::array<Wave, kWaves>, 6> waves_{};
};

}  // namespace liana::simulated
