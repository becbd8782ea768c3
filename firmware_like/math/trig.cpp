#include "firmware_like/math/trig.hpp"

#include <cmath>
#include <cstdint>

namespace liana {

constinit const Series<7> kSineSeries{
    both(-1.0 / 1307674368000.0), both(1.0 / 6227020800.0), both(-1.0 / 39916800.0), both(1.0 / 362880.0),
    both(-1.0 / 5040.0),          both(1.0 / 120.0),        both(-1.0 / 6.0)};
constinit const Series<7> kCosineSeries{
    both(1.0 / 20922789888000.0), both(-1.0 / 87178291200.0), both(1.0 / 479001600.0), both(-1.0 / 3628800.0),
    both(1.0 / 40320.0),          both(-1.0 / 720.0),         both(1.0 / 24.0)};
constinit const Series<12> kExponentialSeries{both(1.0 / 39916800.0),
                                              both(1.0 / 3628800.0),
                                              both(1.0 / 362880.0),
                                              both(1.0 / 40320.0),
                                              both(1.0 / 5040.0),
                                              both(1.0 / 720.0),
                                              both(1.0 / 120.0),
                                              both(1.0 / 24.0),
                                              both(1.0 / 6.0),
                                              both(0.5),
                                              both(1.0),
                                              both(1.0)};
namespace {

// Arc tangent of t in [0, 1]: two half-angle steps bring it under 0.2, where the series ends at 1e-17.
double arc_tangent_unit(double t) noexcept {
  const double half = t / (1.0 + std::sqrt(1.0 + t * t));
  const double r = half / (1.0 + std::sqrt(1.0 + half * half));
  const double x = r * r;
  double p = 1.0 / 21.0;
  p = 1.0 / 19.0 - x * p;
  p = 1.0 / 17.0 - x * p;
  p = 1.0 / 15.0 - x * p;
  p = 1.0 / 13.0 - x * p;
  p = 1.0 / 11.0 - x * p;
  p = 1.0 / 9.0 - x * p;
  p = 1.0 / 7.0 - x * p;
  p = 1.0 / 5.0 - x * p;
  p = 1.0 / 3.0 - x * p;
  return 4.0 * (r - r * x * p);
}

}  // namespace

SinCos wide_sin_cos(double x_rad) noexcept {
  if (!(x_rad >= -1000.0 && x_rad <= 1000.0)) return {0.0, 1.0};
  // Cody-Waite: pi/2 in two parts, the first with 33 bits, so that quadrant * high is exact.
  constexpr double kHigh = 1.57079632673412561417;
  constexpr double kLow = 6.07710050650619224932e-11;
  const double turns = x_rad * (2.0 / kPi);
  const auto quadrant = static_cast<std::int32_t>(turns >= 0.0 ? turns + 0.5 : turns - 0.5);
  const double r = (x_rad - quadrant * kHigh) - quadrant * kLow;
  const auto [s, c] = small_sin_cos(r);
  switch (quadrant & 3) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

double arc_tangent(double y, double x) noexcept {
  const double ax = std::fabs(x);
  const double ay = std::fabs(y);
  if (ax == 0.0 && ay == 0.0) return 0.0;
  double angle = ay <= ax ? arc_tangent_unit(ay / ax) : kPi / 2.0 - arc_tangent_unit(ax / ay);
  if (x < 0.0) angle = kPi - angle;
  return y < 0.0 ? -angle : angle;
}

double wide_exponential(double x) noexcept {
  const double bounded = x > 4.0 ? 4.0 : (x < -4.0 ? -4.0 : x);
  double p = small_exponential(bounded / 16.0);
  p *= p;
  p *= p;
  p *= p;
  return p * p;
}

}  // namespace liana
