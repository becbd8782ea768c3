// The device loop's one rate.
#pragma once

#include <cstdint>

#include "firmware_like/math/pose.hpp"

namespace liana::haptics {

constexpr std::int64_t kTick_us = 1000;
constexpr double kTick_s = 1e-3;

// Where something is and how fast it moves, in one frame.
struct Motion {
  Vec3 position_m{};
  Vec3 velocity_m_s{};
};

// `v` no longer than `most`, its direction kept.
inline Vec3 no_longer(const Vec3& v, double most) noexcept {
  const double length = norm(v);
  return length > most ? scale(v, most / length) : v;
}

}  // namespace liana::haptics
