#include "firmware_like/cable/shape/shape_model.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;
using Rows = std::array<NullVector, kMaxTheta>;

// Cholesky for sizes known at run time only: the leading n x n block, the diagonal then holds 1 / L_jj. False when not
// positive.
bool factor_in_place(Rows& A, Index n) noexcept {
  for (Index j = 0; j < n; ++j) {
    double diagonal = A[j][j];
    for (Index k = 0; k < j; ++k) diagonal -= A[j][k] * A[j][k];
    if (!(diagonal > 0.0)) return false;
    A[j][j] = 1.0 / std::sqrt(diagonal);
    for (Index i = j + 1; i < n; ++i) {
      double sum = A[i][j];
      for (Index k = 0; k < j; ++k) sum -= A[i][k] * A[j][k];
      A[i][j] = sum * A[j][j];
    }
  }
  return true;
}

}  // namespace

ShapeModel resting_model(const NullSpace& space, double weight, const ThetaVector& rest_rad) noexcept {
  ShapeModel model;
  model.pull = coordinates(space, rest_rad);
  for (Index i = 0; i < static_cast<Index>(space.dimension); ++i) {
    for (Index j = 0; j < i; ++j) model.curvature[i][j] = 0.0;
    model.curvature[i][i] = weight;
    model.pull[i] *= weight;
  }
  return model;
}

void reset_pulls(std::int32_t theta_count, PullSum& sum) noexcept {
  for (Index k = 0; k < static_cast<Index>(theta_count); ++k) sum.curvature[k] = ThetaVector{};
  sum.pull = ThetaVector{};
}

void add_pull(const Pull& pull, PullSum& sum) noexcept {
  const double across = pull.distance_m > 0.0 ? pull.weight / larger(pull.distance_m, kSharp_m) : 0.0;
  const double along = pull.weight / larger(pull.excess_m, kSharp_m);
  const Vec3& u = pull.towards;
  std::array<ThetaVector, 4> move;  // of the point by theta: x, y, z, and towards
  for (Index k = 0; k < static_cast<Index>(pull.columns); ++k) {
    const Vec3& column = pull.column[k];
    for (Index i = 0; i < 3; ++i) move[i][k] = column[i];
    move[3][k] = column[0] * u[0] + column[1] * u[1] + column[2] * u[2];
  }
  for (Index k = 0; k < static_cast<Index>(pull.columns); ++k) {
    sum.pull[k] += along * pull.excess_m * move[3][k];
    const Pair more = both((along - across) * move[3][k]), x = both(across * move[0][k]), y = both(across * move[1][k]),
               z = both(across * move[2][k]);
    for (Index j = 0; j <= k; j += 2) {
      double* const entry = &sum.curvature[k][j];
      store_pair(load_pair(entry) + x * load_pair(&move[0][j]) + y * load_pair(&move[1][j]) +
                     z * load_pair(&move[2][j]) + more * load_pair(&move[3][j]),
                 entry);
    }
  }
}

void add_pulls(const NullSpace& space, const PullSum& sum, ShapeModel& model) noexcept {
  const Index m = static_cast<Index>(space.dimension), n = static_cast<Index>(space.theta_count);
  std::array<NullVector, kMaxTheta>
      half;  // lower triangle times the basis, the diagonal halved: the product is symmetric
  for (Index b = 0; b < static_cast<Index>(space.blocks()); ++b) {
    for (Index k = 0; k < n; ++k) {
      Quad row{};
      for (Index j = 0; j <= k; ++j) {
        const Pair entry = both(j == k ? 0.5 * sum.curvature[k][j] : sum.curvature[k][j]);
        row.low += entry * space.block[b][j].low;
        row.high += entry * space.block[b][j].high;
      }
      store_pair(row.low, &half[k][4 * b]);
      store_pair(row.high, &half[k][4 * b + 2]);
    }
  }
  const NullVector pull = coordinates(space, sum.pull);
  std::array<NullVector, kMaxTheta> product;
  for (Index e = 0; e < m; ++e) {
    ThetaVector column;
    for (Index k = 0; k < n; ++k) column[k] = half[k][e];
    product[e] = coordinates(space, column);
  }
  for (Index d = 0; d < m; ++d) {
    model.pull[d] += pull[d];
    for (Index e = 0; e <= d; ++e) model.curvature[d][e] += product[e][d] + product[d][e];
  }
}

ShapeFactor factor(const NullSpace& space, const ShapeModel& model) noexcept {
  ShapeFactor out;
  for (Index i = 0; i < static_cast<Index>(space.dimension); ++i) {
    for (Index j = 0; j <= i; ++j) out.row[i][j] = model.curvature[i][j];
  }
  factor_in_place(out.row, static_cast<Index>(space.dimension));
  return out;
}

void solve_upper(const NullSpace& space, const ShapeFactor& factor, NullVector& b) noexcept {
  const Index n = static_cast<Index>(space.dimension);
  for (Index i = n; i-- > 0;) {
    double sum = b[i];
    for (Index k = i + 1; k < n; ++k) sum -= factor.row[k][i] * b[k];
    b[i] = sum * factor.row[i][i];
  }
}

NullVector minimum(const NullSpace& space, const ShapeFactor& factor, const NullVector& pull) noexcept {
  NullVector z = pull;
  for (Index i = 0; i < static_cast<Index>(space.dimension); ++i) {
    double sum = z[i];
    for (Index k = 0; k < i; ++k) sum -= factor.row[i][k] * z[k];
    z[i] = sum * factor.row[i][i];
  }
  solve_upper(space, factor, z);
  return z;
}

}  // namespace liana::cable
