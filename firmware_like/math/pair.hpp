// Two doubles computed together, lane by lane: a segment's pitch and yaw. The bits are those of two scalars on every target; processors
// with two lanes need half the instructions.
#pragma once

#include <cstring>

namespace liana {

using Pair = double __attribute__((vector_size(16)));  // a language extension that g++ and clang share

inline Pair both(double x) noexcept { return Pair{x, x}; }
inline Pair load_pair(const double* from) noexcept {
  Pair pair;
  std::memcpy(&pair, from, sizeof pair);
  return pair;
}
inline void store_pair(const Pair& pair, double* to) noexcept { std::memcpy(to, &pair, sizeof pair); }

}  // namespace liana
