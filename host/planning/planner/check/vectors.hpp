// Vectors of the independent check, which shares no arithmetic with the core.
#pragma once

#include <array>
#include <cmath>

namespace liana::planner {

inline double product(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace liana::planner
