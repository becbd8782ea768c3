// Deterministic random numbers: one independent stream per purpose, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <string_view>

#include "hil/math/vec3.hpp"

namespace liana::bench {

// splitmix64; the stream is set by the seed and the name of what it is used for.
class Random {
 public:
  Random(std::uint64_t seed, std::string_view purpose) : state_(seed * 0x9E3779B97F4A7C15ULL) {
    for (const char c : purpose) state_ = mix(state_ ^ static_cast<std::uint8_t>(c));
  }

  // Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1.0p-53; }

  // Normal with zero mean and the given standard deviation (Box-Muller, one of the pair).
  double gaussian(double deviation) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return deviation * radius * std::cos(uniform(0.0, 6.283185307179586));
  }

 private:
  static std::uint64_t mix(std::uint64_t z) {
    z += 0x9E3779B97F4A7C15ULL;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  std::uint64_t next() {
    state_ += 0x9E3779B97F4A7C15ULL;
    return mix(state_);
  }

  std::uint64_t state_;
};

// Three of them, x first.
inline Vec3 gaussian(Random& random, double deviation) {
  return {random.gaussian(deviation), random.gaussian(deviation), random.gaussian(deviation)};
}

}  // namespace liana::bench
