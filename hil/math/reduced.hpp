// Vectors and symmetric matrices over the reduced joint angles (two per segment), and their Cholesky solve.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace liana::bench {

constexpr std::size_t kMaxSegments = 8;
constexpr std::size_t kMaxTheta = 2 * kMaxSegments;
constexpr std::size_t kMaxCables = 32;

using Theta = std::array<double, kMaxTheta>;          // per reduced angle: rad, rad/s or N.m
using ThetaMatrix = std::array<Theta, kMaxTheta>;     // rows
using CableValues = std::array<double, kMaxCables>;   // per cable: m or N
using CableJacobian = std::array<Theta, kMaxCables>;  // d length / d theta [m/rad]

// Solves the leading n x n block of the symmetric positive definite a x = b; false when a is not positive definite.
inline bool solve_spd(ThetaMatrix a, const Theta& b, std::size_t n, Theta& x) {
  for (std::size_t j = 0; j < n; ++j) {
    double diagonal = a[j][j];
    for (std::size_t k = 0; k < j; ++k) diagonal -= a[j][k] * a[j][k];
    if (!(diagonal > 0.0)) return false;
    a[j][j] = std::sqrt(diagonal);
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = a[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= a[i][k] * a[j][k];
      a[i][j] = sum / a[j][j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    double sum = b[i];
    for (std::size_t k = 0; k < i; ++k) sum -= a[i][k] * x[k];
    x[i] = sum / a[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = x[i];
    for (std::size_t k = i + 1; k < n; ++k) sum -= a[k][i] * x[k];
    x[i] = sum / a[i][i];
  }
  return true;
}

}  // namespace liana::bench
