// Rates in steps of one tick that can still brake: what the limiters of all kinds of arm are made of.
#pragma once

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana {

// Largest speed from which steps of one tick can still brake within `distance`: v^2 + a h v = 2 a d.
inline double braking_speed(double distance, double accel, double tick_s) noexcept {
  const double step = 0.5 * accel * tick_s;
  return std::sqrt(step * step + 2.0 * accel * distance) - step;
}

// Rate that closes the gap to the reference on top of the reference's own rate.
inline double wanted_rate(double gap_rad, double reference_rate, double accel, double tick_s) noexcept {
  if (gap_rad == 0.0) return reference_rate;
  const double distance = std::fabs(gap_rad);
  double close = braking_speed(distance, accel, tick_s);
  if (close > distance / tick_s) close = distance / tick_s;
  return reference_rate + (gap_rad < 0.0 ? -close : close);
}

// Fastest rate towards a joint limit `room_rad` ahead from which the joint still stops before it: v^2 + 2 a h v = 2 a
// d, under which no later tick needs to brake harder than `accel` or goes past. A joint beyond its limit has no room.
inline double rate_before_limit(double rate, double room_rad, double accel, double tick_s) noexcept {
  const double room = larger(0.0, room_rad);
  const double step = accel * tick_s, size = std::fabs(rate);
  if (size * (size + 2.0 * step) <= 2.0 * accel * room) return rate;
  const double allowed = std::sqrt(step * step + 2.0 * accel * room) - step;
  return rate < 0.0 ? -allowed : allowed;
}

}  // namespace liana
