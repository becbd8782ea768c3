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

// Sine and cosine of x [rad], |x| <= 1000: absolute error <= 3e-16 for |x| <= pi/4, <= 1e-13 elsewhere. Larger or not finite x give {0, 1}.
SinCos sin_cos(double x_rad) noexcept;

// Angle of the point (x, y) in [-pi, pi]; absolute error <= 1e-15; atan2(0, 0) = 0.
double arc_tangent(double y, double x) noexcept;

// e^x for |x| <= 4: relative error <= 1e-14; outside, x is taken at the nearer end.
double exponential(double x) noexcept;

}  // namespace liana
