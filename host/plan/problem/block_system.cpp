#include "host/plan/problem/block_system.hpp"

#include <cmath>

namespace liana {
namespace {

using Index = std::size_t;
using Matrix = ThetaHessian;

// L of a positive matrix in place; false when it is not.
bool factor(Matrix& A, Index n) {
  for (Index j = 0; j < n; ++j) {
    for (Index k = 0; k < j; ++k) A[j][j] -= A[j][k] * A[j][k];
    if (!(A[j][j] > 0.0)) return false;
    A[j][j] = std::sqrt(A[j][j]);
    for (Index i = j + 1; i < n; ++i) {
      for (Index k = 0; k < j; ++k) A[i][j] -= A[i][k] * A[j][k];
      A[i][j] /= A[j][j];
    }
  }
  return true;
}

}  // namespace

bool solve(BlockSystem& system, Index n) {
  const Index blocks = system.own.size();
  for (Index w = 0; w < blocks; ++w) {
    Matrix& L = system.own[w];
    if (!factor(L, n)) return false;
    for (Index i = 0; i < n; ++i) {
      for (Index k = 0; k < i; ++k) system.rhs[w][i] -= L[i][k] * system.rhs[w][k];
      system.rhs[w][i] /= L[i][i];
    }
    if (w + 1 == blocks) break;
    Matrix& M = system.next[w];  // becomes next L^-T
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        for (Index k = 0; k < j; ++k) M[i][j] -= M[i][k] * L[j][k];
        M[i][j] /= L[j][j];
      }
    }
    for (Index i = 0; i < n; ++i) {
      for (Index k = 0; k < n; ++k) {
        system.rhs[w + 1][i] -= M[i][k] * system.rhs[w][k];
        for (Index j = 0; j <= i; ++j) system.own[w + 1][i][j] -= M[i][k] * M[j][k];
      }
    }
  }
  for (Index w = blocks; w-- > 0;) {
    if (w + 1 < blocks) {
      for (Index i = 0; i < n; ++i) {
        for (Index k = 0; k < n; ++k) system.rhs[w][i] -= system.next[w][k][i] * system.rhs[w + 1][k];
      }
    }
    for (Index i = n; i-- > 0;) {
      for (Index k = i + 1; k < n; ++k) system.rhs[w][i] -= system.own[w][k][i] * system.rhs[w][k];
      system.rhs[w][i] /= system.own[w][i][i];
    }
  }
  return true;
}

}  // namespace liana
