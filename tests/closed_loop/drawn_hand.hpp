// Hands that are not gentle, drawn by a seed: waves with rounded corners, chirps, steps and random walks, of position
// and attitude, up to so many times what the tip may do.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::closed_loop {

enum class HandKind : std::uint8_t { kWave, kChirp, kSteps, kWalk };

// Most that a hand does.
struct HandBounds {
  double speed_m_s = 0.3, accel_m_s2 = 2.2;
  double rate_rad_s = 1.05, accel_rad_s2 = 7.7;
  double way_m = 0.10, turn_rad = 0.35;  // from the middle
};

class DrawnHand {
 public:
  DrawnHand(std::uint64_t seed, const HandBounds& bounds);

  // Pose of the hand, which starts at rest in the origin. Times must not go back.
  Pose at(double time_s);
  const std::string& name() const { return name_; }

 private:
  // One coordinate: goes after a target that jumps within speed and acceleration.
  struct Channel {
    double max_speed = 0.0, max_accel = 0.0, max_way = 0.0;
    double period_s = 0.0, phase = 0.0, chirp = 0.0;
    double value = 0.0, rate = 0.0, target = 0.0, until_s = 0.0;
  };

  void advance(Channel& channel, double time_s, double step_s);
  double target(Channel& channel, double time_s);
  double uniform();

  HandKind kind_ = HandKind::kWave;
  std::uint64_t state_;
  std::string name_;
  std::vector<std::pair<std::size_t, Channel>> channels_;  // 0..2: position, 3..5: rotation vector
  double time_s_ = 0.0;
};

}  // namespace liana::closed_loop
