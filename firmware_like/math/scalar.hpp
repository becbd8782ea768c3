// Scalars: the few helpers that would otherwise come from libm.
#pragma once

#include "firmware_like/math/arithmetic.hpp"

namespace liana {

constexpr double smaller(double a, double b) noexcept { return a < b ? a : b; }
constexpr double larger(double a, double b) noexcept { return a > b ? a : b; }
constexpr double clamp(double x, double low, double high) noexcept { return x < low ? low : (x > high ? high : x); }
// True for every number that is neither infinite nor NaN.
constexpr bool is_finite(double x) noexcept { return x - x == 0.0; }

}  // namespace liana
