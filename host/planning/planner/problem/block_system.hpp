// Linear systems of start paths: symmetric, positive, a block per waypoint, each coupled with its neighbours only.
#pragma once

#include <vector>

#include "host/base/eigen/thetas.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

struct BlockSystem {
  std::vector<eigen::ThetaMatrix> own;
  std::vector<eigen::ThetaMatrix> next;  // [w]: rows of waypoint w + 1, columns of w
  std::vector<eigen::ThetaColumn> rhs;
  BlockSystem(std::size_t blocks, Eigen::Index thetas)
      : own(blocks, eigen::ThetaMatrix::Zero(thetas, thetas)),
        next(own),
        rhs(blocks, eigen::ThetaColumn::Zero(thetas)) {}
};

// Solves in place of rhs by block Cholesky; false when the matrix is not positive. `own` and `next` are used up.
bool solve(BlockSystem& system);

}  // namespace liana::planner
