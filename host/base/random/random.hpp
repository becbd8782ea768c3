// Small seeded random numbers: the same on every machine, unlike the distributions of <random>.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace liana::simulated {

// SplitMix64 stream; one per purpose, so that adding a draw in one place moves nothing elsewhere.
class RandomStream {
 public:
  // `purpose` separates streams of one seed.
  RandomStream(std::uint64_t seed, std::uint64_t purpose)
      : state_(seed * 0x9E3779B97F4A7C15ULL + purpose * 0xD1B54A32D192ED03ULL) {
    next();
  }

  // 64 random bits.
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

  // Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1.0p-53; }

  // Normal with zero mean and standard deviation `sigma`.
  double normal(double sigma) {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(0.0, 1.0)));
    return sigma * radius * std::cos(2.0 * std::numbers::pi * uniform(0.0, 1.0));
  }

 private:
  std::uint64_t state_;
};

}  // namespace liana::simulated
