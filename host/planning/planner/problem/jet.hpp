// Second-order forward-mode derivatives by two variables, the pitch and yaw of one segment.
//
// A number together with its first and second derivatives; every operation carries them along (chain and product rule),
// so whatever is computed from angles has exact derivatives. Two variables are enough: a segment depends on its own
// angles only, and what lies between segments is a product of rotations (arm_derivatives.hpp).
#pragma once

#include <cmath>

namespace liana::planner {

struct Jet {
  double value = 0.0;
  double a = 0.0, b = 0.0;              // by pitch, by yaw
  double aa = 0.0, ab = 0.0, bb = 0.0;  // second derivatives
};

constexpr Jet constant(double value) { return {value, 0, 0, 0, 0, 0}; }
constexpr Jet pitch_variable(double value) { return {value, 1, 0, 0, 0, 0}; }
constexpr Jet yaw_variable(double value) { return {value, 0, 1, 0, 0, 0}; }

constexpr Jet operator+(const Jet& x, const Jet& y) {
  return {x.value + y.value, x.a + y.a, x.b + y.b, x.aa + y.aa, x.ab + y.ab, x.bb + y.bb};
}
constexpr Jet operator*(double s, const Jet& x) {
  return {s * x.value, s * x.a, s * x.b, s * x.aa, s * x.ab, s * x.bb};
}
constexpr Jet operator-(const Jet& x) { return -1.0 * x; }
constexpr Jet operator-(const Jet& x, const Jet& y) { return x + -y; }
constexpr Jet operator*(const Jet& x, const Jet& y) {
  return {x.value * y.value,
          x.a * y.value + x.value * y.a,
          x.b * y.value + x.value * y.b,
          x.aa * y.value + 2.0 * x.a * y.a + x.value * y.aa,
          x.ab * y.value + x.a * y.b + x.b * y.a + x.value * y.ab,
          x.bb * y.value + 2.0 * x.b * y.b + x.value * y.bb};
}

// f(x) from f, f' and f'' at x.value.
constexpr Jet chain(const Jet& x, double f, double df, double ddf) {
  return {f, df * x.a, df * x.b, df * x.aa + ddf * x.a * x.a, df * x.ab + ddf * x.a * x.b, df * x.bb + ddf * x.b * x.b};
}
inline Jet sin(const Jet& x) { return chain(x, std::sin(x.value), std::cos(x.value), -std::sin(x.value)); }
inline Jet cos(const Jet& x) { return chain(x, std::cos(x.value), -std::sin(x.value), -std::cos(x.value)); }
// x.value > 0.
inline Jet sqrt(const Jet& x) {
  const double root = std::sqrt(x.value);
  return chain(x, root, 0.5 / root, -0.25 / (root * x.value));
}

// Derivative by angle i (0 pitch, 1 yaw), and by i and j.
constexpr double first(const Jet& x, std::size_t i) { return i == 0 ? x.a : x.b; }
constexpr double second(const Jet& x, std::size_t i, std::size_t j) { return i != j ? x.ab : (i == 0 ? x.aa : x.bb); }

}  // namespace liana::planner
