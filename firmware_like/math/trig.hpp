// Own elementary functions, so that every target computes the same bits (docs/determinism.md).
// Only + - * / and sqrt are used. Errors are against the exact value, tested over the whole range stated.
#pragma once

namespace liana {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

struct SinCos {
  double sin;
  double cos;
};

// Sine and cosine of x [rad], |x| <= pi/4: absolute error <= 3e-16. Taylor series; the first term left out is below 1e-17.
inline SinCos small_sin_cos(double x_rad) noexcept {
  const double x = x_rad * x_rad;
  double s = -1.0 / 1307674368000.0;  // -1/15!
  s = s * x + 1.0 / 6227020800.0;
  s = s * x - 1.0 / 39916800.0;
  s = s * x + 1.0 / 362880.0;
  s = s * x - 1.0 / 5040.0;
  s = s * x + 1.0 / 120.0;
  s = s * x - 1.0 / 6.0;
  double c = 1.0 / 20922789888000.0;  // 1/16!
  c = c * x - 1.0 / 87178291200.0;
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

// Angle of the point (x, y) in [-pi, pi]; absolute error <= 1e-15; atan2(0, 0) = 0.
double arc_tangent(double y, double x) noexcept;

// e^x for |x| <= 4: relative error <= 1e-14; outside, x is taken at the nearer end.
double exponential(double x) noexcept;

}  // namespace liana
