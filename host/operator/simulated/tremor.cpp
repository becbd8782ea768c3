#include "host/operator/simulated/tremor.hpp"

#include <cmath>
#include <numbers>

#include "host/base/random/random.hpp"

namespace liana::simulated {

Tremor::Tremor(double position_m, double rotation_rad, std::uint64_t seed, std::uint64_t purpose, double lowest_hz,
               double highest_hz)
    : position_m_(position_m), rotation_rad_(rotation_rad) {
  RandomStream random(seed, purpose);
  for (auto& axis : waves_) {
    for (Wave& wave : axis) {
      wave.rate_rad_s = 2.0 * std::numbers::pi * random.uniform(lowest_hz, highest_hz);
      wave.phase_rad = random.uniform(0.0, 2.0 * std::numbers::pi);
    }
  }
}

double Tremor::axis(std::size_t index, double t_s) const {
  double sum = 0.0;
  for (const Wave& wave : waves_[index]) sum += std::sin(wave.rate_rad_s * t_s + wave.phase_rad);
  return sum * std::sqrt(2.0 / static_cast<double>(kWaves));  // RMS 1
}

Pose Tremor::apply(const Pose& pose, double t_s) const {
  const Vec3 shift{axis(0, t_s), axis(1, t_s), axis(2, t_s)};
  const Vec3 turn{axis(3, t_s), axis(4, t_s), axis(5, t_s)};
  return {add(pose.position_m, scale(shift, position_m_)),
          multiply(quaternion_of(scale(turn, rotation_rad_)), pose.quaternion)};
}

}  // namespace liana::simulated
