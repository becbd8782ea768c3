// Cholesky factorisation of a small symmetric positive matrix, sums in written order.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace liana {

template <std::size_t Capacity>
using SquareMatrix = std::array<std::array<double, Capacity>, Capacity>;

// Factors the leading n x n part of A (lower triangle read) into L L^T in place and solves for x in place of b.
// Returns false, x = 0, when A is not positive definite. Cost: n^3 / 6 multiplications.
template <std::size_t Capacity>
bool cholesky_solve(SquareMatrix<Capacity>& A, std::array<double, Capacity>& b, std::size_t n) noexcept {
  for (std::size_t j = 0; j < n; ++j) {
    double diagonal = A[j][j];
    for (std::size_t k = 0; k < j; ++k) diagonal -= A[j][k] * A[j][k];
    if (!(diagonal > 0.0)) {
      b.fill(0.0);
      return false;
    }
    const double root = std::sqrt(diagonal);
    const double inverse_root = 1.0 / root;
    A[j][j] = root;
    for (std::size_t i = j + 1; i < n; ++i) {
      double sum = A[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
      A[i][j] = sum * inverse_root;
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    double sum = b[i];
    for (std::size_t k = 0; k < i; ++k) sum -= A[i][k] * b[k];
    b[i] = sum / A[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = b[i];
    for (std::size_t k = i + 1; k < n; ++k) sum -= A[k][i] * b[k];
    b[i] = sum / A[i][i];
  }
  return true;
}

}  // namespace liana
