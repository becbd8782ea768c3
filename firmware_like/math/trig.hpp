// Own elementary functions, so that every target computes the same bits (docs/explanation/determinism.md).
// Only + - * / and sqrt are used. Errors are against the exact value, tested over the whole range stated.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "firmware_like/math/pair.hpp"

namespace liana {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180.0;

template <class Number>
struct SinCosOf {
  Number sin, cos;
};
using SinCos = SinCosOf<double>;

// Coefficients of a power series, highest power first, each twice: read from memory they cost nothing, while compilers
// build a Pair of equal constants with two instructions more.
template <std::size_t N>
using Series = std::array<Pair, N>;
extern const Series<7> kSineSeries;          // (sin x / x - 1) / x^2 in x^2: -1/15! ... -1/3!
extern const Series<7> kCosineSeries;        // (cos x - 1 + x^2 / 2) / x^4 in x^2: 1/16! ... 1/4!
extern const Series<12> kExponentialSeries;  // 1/11! ... 1/0!

template <class Number>
Number coefficient(const Pair& twice) noexcept {
  if constexpr (std::is_same_v<Number, Pair>)
    return twice;
  else
    return twice[0];
}
// Horner's rule for a double or a Pair.
template <class Number, std::size_t N>
Number evaluate(const Series<N>& series, const Number& x) noexcept {
  return [&]<std::size_t... I>(std::index_sequence<I...>) {
    Number p = coefficient<Number>(series[0]);
    ((p = p * x + coefficient<Number>(series[I + 1])), ...);
    return p;
  }
  (std::make_index_sequence<N - 1>{});
}

// Sine and cosine of x [rad], |x| <= pi/4, for a double or a Pair: absolute error <= 3e-16. Taylor series; the first
// term left out is below 1e-17.
template <class Number>
SinCosOf<Number> small_sin_cos(const Number& x_rad) noexcept {
  const Number x = x_rad * x_rad;
  return {x_rad + x_rad * x * evaluate(kSineSeries, x), 1.0 - 0.5 * x + x * x * evaluate(kCosineSeries, x)};
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
template <class Number>
Number small_exponential(const Number& x) noexcept {
  return evaluate(kExponentialSeries, x);
}

// e^x for |x| <= 4: relative error <= 1e-14; outside, x is taken at the nearer end.
double wide_exponential(double x) noexcept;
inline double exponential(double x) noexcept {
  return std::fabs(x) <= 0.25 ? small_exponential(x) : wide_exponential(x);
}
inline Pair exponential(const Pair& x) noexcept {
  return within(x, 0.25) ? small_exponential(x) : Pair{wide_exponential(x[0]), wide_exponential(x[1])};
}
}  // namespace liana
