#include "host/planning/planner/problem/planned_tension.hpp"

#include <algorithm>

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kFirst_rad = 1e-5;
constexpr double kSecond_rad = 1e-4;

}  // namespace

CableVector PlannedTension::at(const ThetaVector& theta_rad) const {
  return plan_at_rest(table_, layout_, theta_rad).motor_N;
}

std::array<ThetaVector, kMaxCables> PlannedTension::by_theta(const ThetaVector& theta_rad) const {
  std::array<ThetaVector, kMaxCables> out{};
  ThetaVector theta = theta_rad;
  for (Index k = 0; k < static_cast<Index>(table_.theta_count()); ++k) {
    theta[k] = theta_rad[k] + kFirst_rad;
    const CableVector after = at(theta);
    theta[k] = theta_rad[k] - kFirst_rad;
    const CableVector before = at(theta);
    theta[k] = theta_rad[k];
    for (Index c = 0; c < out.size(); ++c) out[c][k] = (after[c] - before[c]) / (2.0 * kFirst_rad);
  }
  return out;
}

void PlannedTension::add_hessian(const ThetaVector& theta_rad, const CableVector& weight, ThetaHessian& hessian) const {
  const Index n = static_cast<Index>(table_.theta_count());
  // weight . tension where theta i and theta j have moved by `step`; i == j: only one has.
  const auto sum_at = [&](Index i, Index j, double step) {
    ThetaVector theta = theta_rad;
    theta[i] += step;
    if (j != i) theta[j] += step;
    const CableVector tension_N = at(theta);
    double sum = 0.0;
    for (Index c = 0; c < tension_N.size(); ++c) sum += weight[c] * tension_N[c];
    return sum;
  };
  constexpr double kPerSquare = 1.0 / (kSecond_rad * kSecond_rad);
  const double here = sum_at(0, 0, 0.0);
  ThetaVector both{};  // sum of the values one step forwards and backwards, less twice the value here
  for (Index i = 0; i < n; ++i) {
    both[i] = sum_at(i, i, kSecond_rad) + sum_at(i, i, -kSecond_rad) - 2.0 * here;
    hessian[i][i] += kPerSquare * both[i];
    for (Index j = 0; j < i; ++j) {
      const double corners = sum_at(i, j, kSecond_rad) + sum_at(i, j, -kSecond_rad) - 2.0 * here;
      hessian[i][j] += 0.5 * kPerSquare * (corners - both[i] - both[j]);
    }
  }
}

double PlannedTension::excess_N(const ThetaVector& theta_rad) const {
  const CableVector planned_N = at(theta_rad);
  const std::span<const double> tension_N = of_cables(table_, planned_N);
  const auto [least, most] = std::minmax_element(tension_N.begin(), tension_N.end());
  return std::max(table_.tension.floor_motor_N - *least, *most - table_.tension.ceiling_free_N);
}

}  // namespace liana::planner
