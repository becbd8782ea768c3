// Null-space coordinates four at a time: the arithmetic of bounds (active_set.hpp).
#pragma once

#include <array>
#include <cstddef>

#include "firmware_like/cable/shape/null_space.hpp"

namespace liana::cable {

// Null-space coordinates, B lanes of four; those beyond the dimension are zero.
template <std::size_t B>
using Lanes = std::array<Quad, B>;

template <std::size_t B>
inline double product(const Lanes<B>& a, const Lanes<B>& b) noexcept {
  Pair products = a[0].low * b[0].low + a[0].high * b[0].high;
  for (std::size_t i = 1; i < B; ++i) products += a[i].low * b[i].low + a[i].high * b[i].high;
  return sum(products);
}

template <std::size_t B>
inline void add_scaled(double s, const Lanes<B>& x, Lanes<B>& y) noexcept {
  const Pair twice = both(s);
  for (std::size_t i = 0; i < B; ++i) {
    y[i].low += twice * x[i].low;
    y[i].high += twice * x[i].high;
  }
}

template <std::size_t B>
inline Lanes<B> scaled(double s, const Lanes<B>& x) noexcept {
  const Pair twice = both(s);
  Lanes<B> y;
  for (std::size_t i = 0; i < B; ++i) y[i] = {twice * x[i].low, twice * x[i].high};
  return y;
}

template <std::size_t B>
inline Lanes<B> lanes_of(const NullVector& z) noexcept {
  Lanes<B> lanes;
  for (std::size_t b = 0; b < B; ++b) lanes[b] = {load_pair(&z[4 * b]), load_pair(&z[4 * b + 2])};
  return lanes;
}

template <std::size_t B>
inline NullVector numbers_of(const Lanes<B>& lanes) noexcept {
  NullVector z;
  for (std::size_t b = 0; b < B; ++b) {
    store_pair(lanes[b].low, &z[4 * b]);
    store_pair(lanes[b].high, &z[4 * b + 2]);
  }
  return z;
}

}  // namespace liana::cable
