// Linear systems of start paths: symmetric, positive, a block per waypoint, each coupled with its neighbours only.
#pragma once

#include <cstddef>
#include <vector>

#include "host/plan/problem/arm_derivatives.hpp"

namespace liana {

using namespace cable;  // this room serves the cable arm only

struct BlockSystem {
  std::vector<ThetaHessian> own;   // lower triangles
  std::vector<ThetaHessian> next;  // [w]: rows of waypoint w + 1, columns of w
  std::vector<ThetaVector> rhs;
  explicit BlockSystem(std::size_t blocks) : own(blocks), next(blocks), rhs(blocks) {}
};

// Solves in place of rhs by block Cholesky, the first n rows of each block; false when the matrix is not positive.
bool solve(BlockSystem& system, std::size_t n);

}  // namespace liana
