// Cholesky factorisation of a small symmetric positive matrix, sums in written order.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace liana {

template <std::size_t Capacity>
using SquareMatrix = std::array<std::array<double, Capacity>, Capacity>;

// Factors A (lower triangle read) into L L^T in place; the diagonal then holds 1 / L_jj, for the solves.
// Returns false when A is not positive definite. Cost: n^3 / 6 multiplications.
template <std::size_t n>
bool cholesky_factor(SquareMatrix<n>& A) noexcept {
  for (std::size_t j = 0; j < n; ++j) {
    double* const row_j = A[j].data();
    double diagonal = row_j[j];
    for (std::size_t k = 0; k < j; ++k) diagonal -= row_j[k] * row_j[k];
    if (!(diagonal > 0.0)) return false;
    const double inverse_root = 1.0 / std::sqrt(diagonal);
    row_j[j] = inverse_root;
    for (std::size_t i = j + 1; i < n; ++i) {
      double* const row_i = A[i].data();
      double sum = row_i[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row_i[k] * row_j[k];
      row_i[j] = sum * inverse_root;
    }
  }
  return true;
}

// Solves A x = b in place of b with the factor from cholesky_factor. Cost: n^2 multiplications.
template <std::size_t n>
void cholesky_solve(const SquareMatrix<n>& factor, std::array<double, n>& b) noexcept {
  for (std::size_t i = 0; i < n; ++i) {
    double sum = b[i];
    for (std::size_t k = 0; k < i; ++k) sum -= factor[i][k] * b[k];
    b[i] = sum * factor[i][i];
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = b[i];
    for (std::size_t k = i + 1; k < n; ++k) sum -= factor[k][i] * b[k];
    b[i] = sum * factor[i][i];
  }
}

}  // namespace liana
