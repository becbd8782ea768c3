// Two doubles computed together, lane by lane: a segment's pitch and yaw. The bits are those of two scalars on every
// target; processors with two lanes need half the instructions.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

#include "firmware_like/math/arithmetic.hpp"

namespace liana {

using Pair = double __attribute__((vector_size(16)));  // a language extension that g++ and clang share

constexpr Pair both(double x) noexcept { return Pair{x, x}; }
inline Pair load_pair(const double* from) noexcept {
  Pair pair;
  std::memcpy(&pair, from, sizeof pair);
  return pair;
}
inline void store_pair(const Pair& pair, double* to) noexcept { std::memcpy(to, &pair, sizeof pair); }

inline double sum(const Pair& pair) noexcept { return pair[0] + pair[1]; }

// Sum of a[k] b[k] and y[k] += s x[k] over `count` pairs of numbers: thetas come in pairs.
inline double dot_pairs(const double* a, const double* b, std::size_t count) noexcept {
  Pair products{};
  for (std::size_t i = 0; i < count; ++i) products += load_pair(a + 2 * i) * load_pair(b + 2 * i);
  return sum(products);
}
inline void add_scaled_pairs(double s, const double* x, double* y, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) store_pair(load_pair(y + 2 * i) + s * load_pair(x + 2 * i), y + 2 * i);
}

// True when both lanes lie in [-limit, limit]; false for NaN.
inline bool within(const Pair& x, double limit) noexcept {
  return std::fabs(x[0]) <= limit && std::fabs(x[1]) <= limit;
}

}  // namespace liana
