// Own elementary functions, so that every target computes the same bits (docs/determinism.md).
// Only + - * / and sqrt are used. Errors are against the exact value, tested over the whole range stated.
#pragma once

#include <cmath>

#include "firmware_like/math/pair.hpp"

namespace liana {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

template <class Number>
struct SinCosOf {
  Number sin, cos;
};
using SinCos = SinCosOf<double>;

// Sine and cosine of x [rad], |x| <= pi/4, for a double or a Pair: absolute error <= 3e-16. Taylor series; the first term left out is
// below 1e-17.
template <class Number>
SinCosOf<Number> small_sin_cos(Number x_rad) noexcept {
  const Number x = x_rad * x_rad;
  Number s = x * (-1.0 / 1307674368000.0) + 1.0 / 6227020800.0;  // -1/15! and so on
  s = s * x - 1.0 / 39916800.0;
  s = s * x + 1.0 / 362880.0;
  s = s * x - 1.0 / 5040.0;
  s = s * x + 1.0 / 120.0;
  s = s * x - 1.0 / 6.0;
  Number c = x * (1.0 / 20922789888000.0) - 1.0 / 87178291200.0;  // 1/16! and so on
  c = c * x + 1.0 / 479001600.0;
  c = c * x - 1.0 / 3628800.0;
  c = c * x + 1.0 / 40320.0;
  c = c * x - 1.0 / 720.0;
  c = c * x + 1.0 / 24.0;
  return {x_rad + x_rad * x * s, 1.0 - 0.5 * x + x * x * c};
}

// The same for |x| <= 1000, by range reduction: absolute error <= 1e-13. Larger or not finite x give {0, 1}.
SinCos wide_sin_cos(double x_rad) noexcept;

// Sine and cosine of x [rad], |x| <= 1000. Joint angles take the short way.
inline SinCos sin_cos(double x_rad) noexcept {
  return x_rad >= -0.25 * kPi && x_rad <= 0.25 * kPi ? small_sin_cos(x_rad) : wide_sin_cos(x_rad);
}

inline SinCosOf<Pair> sin_cos(const Pair& x_rad) noexcept {
  if (within(x_rad, 0.25 * kPi)) return small_sin_cos(x_rad);
  const SinCos first = sin_cos(x_rad[0]), second = sin_cos(x_rad[1]);
  return {Pair{first.sin, second.sin}, Pair{first.cos, second.cos}};
}

// Angle of the point (x, y) in [-pi, pi]; absolute error <= 1e-15; atan2(0, 0) = 0.
double arc_tangent(double y, double x) noexcept;

// e^x for |x| <= 1/4: relative error <= 1e-15. Series whose first term left out is below 2e-16.
inline double small_exponential(double x) noexcept {
  double p = 1.0 / 39916800.0;  // 1/11!
  p = p * x + 1.0 / 3628800.0;
  p = p * x + 1.0 / 362880.0;
  p = p * x + 1.0 / 40320.0;
  p = p * x + 1.0 / 5040.0;
  p = p * x + 1.0 / 720.0;
  p = p * x + 1.0 / 120.0;
  p = p * x + 1.0 / 24.0;
  p = p * x + 1.0 / 6.0;
  p = p * x + 0.5;
  p = p * x + 1.0;
  return p * x + 1.0;
}

// e^x for |x| <= 4: relative error <= 1e-14; outside, x is taken at the nearer end.
double wide_exponential(double x) noexcept;
inline double exponential(double x) noexcept { return std::fabs(x) <= 0.25 ? small_exponential(x) : wide_exponential(x); }
}  // namespace liana
