#include "host/planning/planner/problem/block_system.hpp"

namespace liana::planner {

bool solve(BlockSystem& system) {
  const std::size_t blocks = system.own.size();
  std::vector<Eigen::LLT<eigen::ThetaMatrix>> factor(blocks);
  for (std::size_t w = 0; w < blocks; ++w) {
    if (factor[w].compute(system.own[w]).info() != Eigen::Success) return false;
    factor[w].matrixL().solveInPlace(system.rhs[w]);
    if (w + 1 == blocks) break;
    eigen::ThetaMatrix& below = system.next[w];  // becomes its block of the factor
    factor[w].matrixU().solveInPlace<Eigen::OnTheRight>(below);
    system.rhs[w + 1].noalias() -= below * system.rhs[w];
    system.own[w + 1].noalias() -= below * below.transpose();
  }
  for (std::size_t w = blocks; w-- > 0;) {
    if (w + 1 < blocks) system.rhs[w].noalias() -= system.next[w].transpose() * system.rhs[w + 1];
    factor[w].matrixU().solveInPlace(system.rhs[w]);
  }
  return true;
}

}  // namespace liana::planner
