// Values and derivatives of the problem; its structure is in plan_problem.cpp.
#include <algorithm>
#include <cmath>

#include "host/planning/planner/problem/plan_problem.hpp"
#include "host/planning/planner/problem/point_distance.hpp"

namespace liana::planner {
namespace {

constexpr double kPer_N = 1e-3;  // of tension rows

// Adds J^T M J for a symmetric M.
void add_projected(const std::array<Vec3, 3>& M, const PointDerivatives& at, std::size_t thetas, ThetaHessian& out) {
  for (std::size_t k = 0; k < thetas; ++k) {
    const Vec3 Mk{dot(M[0], at.by_theta[k]), dot(M[1], at.by_theta[k]), dot(M[2], at.by_theta[k])};
    for (std::size_t j = 0; j <= k; ++j) out[k][j] += dot(Mk, at.by_theta[j]);
  }
}

std::array<Vec3, 3> scaled(std::array<Vec3, 3> M, double factor) {
  for (Vec3& row : M) row = scale(row, factor);
  return M;
}

// The rounded distance of a node from its target.
struct NodeDistance {
  double value_m = 0.0;
  Vec3 slope{};
  double rounded_m = 0.0;  // sqrt(d^2 + kRound^2)
};

NodeDistance node_distance(const Vec3& node_m, const Vec3& target_m) {
  const Vec3 away = subtract(node_m, target_m);
  const double rounded_m = std::sqrt(dot(away, away) + kRound_m * kRound_m);
  return {rounded_m - kRound_m, scale(away, 1.0 / rounded_m), rounded_m};
}

PointDistance row_distance(const ClearanceRow& row, const Vec3& point, const config::SceneConfig& scene) {
  if (!row.plane) return point_distance(point, scene, row.obstacle);
  return {dot(row.plane->normal, point) - row.plane->offset_m, row.plane->normal, {}};
}

}  // namespace

void PlanProblem::evaluate(const double* x) {
  if (!path_.empty() && std::equal(evaluated_x_.begin(), evaluated_x_.end(), x)) return;
  evaluated_x_.assign(x, x + variables());
  path_ = path_of(x);
  const RobotParams& table = request_.robot.table;
  at_place_.clear();
  for (const PathPlace& place : places_) at_place_.emplace_back(table, theta_at(path_, place));
  at_waypoint_.clear();
  if (has_tip() || !request_.control_points.empty()) {
    for (const ThetaVector& theta : path_) at_waypoint_.emplace_back(table, theta);
  }
  cables_.clear();
  if (!rows_.cable.empty()) {
    for (const ThetaVector& theta : path_) cables_.push_back(cable_derivatives(table, theta));
  }
}

double PlanProblem::objective(const double* x) {
  evaluate(x);
  double squares = 0.0, distances = 0.0;
  for (Index w = 0; w < last(); ++w) {
    for (Index k = 0; k < thetas(); ++k) squares += (path_[w + 1][k] - path_[w][k]) * (path_[w + 1][k] - path_[w][k]);
    for (const ControlPoint& target : request_.control_points) {
      const ArmDerivatives& arm = at_waypoint_[w + 1];
      distances +=
          target.weight * node_distance(arm.point(arm.node(target.node)).position_m, target.position_m).value_m;
    }
  }
  const double intervals = static_cast<double>(last());
  return 0.5 * intervals * squares + distances / intervals;
}

void PlanProblem::gradient(const double* x, double* out) {
  evaluate(x);
  std::fill(out, out + variables(), 0.0);
  const double intervals = static_cast<double>(last());
  for (Index w = 0; w < last(); ++w) {
    for (Index k = 0; k < thetas(); ++k) {
      const double step = intervals * (path_[w + 1][k] - path_[w][k]);
      if (variable_[w][k] >= 0) out[variable_[w][k]] -= step;
      if (variable_[w + 1][k] >= 0) out[variable_[w + 1][k]] += step;
    }
    for (const ControlPoint& target : request_.control_points) {
      const PointDerivatives node = at_waypoint_[w + 1].point(at_waypoint_[w + 1].node(target.node));
      const Vec3 slope = node_distance(node.position_m, target.position_m).slope;
      for (Index k = 0; k < thetas(); ++k) {
        if (variable_[w + 1][k] >= 0)
          out[variable_[w + 1][k]] += target.weight / intervals * dot(slope, node.by_theta[k]);
      }
    }
  }
}

void PlanProblem::constraint_values(const double* x, double* out) {
  evaluate(x);
  if (has_tip()) {
    const ArmDerivatives& arm = at_waypoint_.back();
    const Vec3 away =
        subtract(arm.point(arm.node(request_.robot.table.segment_count)).position_m, request_.tip_in_base->position_m);
    const Quat turned = multiply(conjugate(request_.tip_in_base->quaternion), arm.tip_quaternion());
    for (Index i = 0; i < 3; ++i) *out++ = away[i];
    for (Index i = 1; i < 4; ++i) *out++ = turned[i];
  }
  for (Index i = 0; i < rows_.clearance.size(); ++i) {
    const ClearanceRow& row = rows_.clearance[i];
    *out++ = row_distance(row, at_place_[place_of_row_[i]].point(row.where).position_m, request_.scene).distance_m;
  }
  for (const StepRow& row : rows_.step) {
    const Index w = static_cast<Index>(row.interval), k = static_cast<Index>(row.theta);
    *out++ = path_[w + 1][k] - path_[w][k];
  }
  for (const CableRow& row : rows_.cable) {
    const Index w = static_cast<Index>(row.interval), c = static_cast<Index>(row.cable);
    *out++ = cables_[w + 1].length_m[c] - cables_[w].length_m[c];
  }
  for (const TensionRow& row : rows_.tension) {
    *out++ = kPer_N * tension_.at(path_[static_cast<Index>(row.waypoint)])[static_cast<Index>(row.cable)];
  }
}

void PlanProblem::jacobian(const double* x, double* out) {
  evaluate(x);
  // Values in the order of build_jacobian: thetas of one waypoint that are free there, times a share.
  const auto put = [&](Index waypoint, Index count, double share, const auto& by_theta) {
    for (Index k = 0; k < count; ++k) {
      if (variable_[waypoint][k] >= 0) *out++ = share * by_theta(k);
    }
  };
  if (has_tip()) {
    const ArmDerivatives& arm = at_waypoint_.back();
    const PointDerivatives tip = arm.point(arm.node(request_.robot.table.segment_count));
    const auto turns = arm.tip_quaternion_by_theta();
    const Quat back = conjugate(request_.tip_in_base->quaternion);
    for (Index i = 0; i < 3; ++i) put(last(), thetas(), 1.0, [&](Index k) { return tip.by_theta[k][i]; });
    for (Index i = 1; i < 4; ++i) put(last(), thetas(), 1.0, [&](Index k) { return multiply(back, turns[k])[i]; });
  }
  for (Index i = 0; i < rows_.clearance.size(); ++i) {
    const ClearanceRow& row = rows_.clearance[i];
    const PointDerivatives point = at_place_[place_of_row_[i]].point(row.where);
    const Vec3 normal = row_distance(row, point.position_m, request_.scene).normal;
    const auto slope = [&](Index k) { return dot(normal, point.by_theta[k]); };
    const Index w = static_cast<Index>(row.place.interval), count = thetas_before(request_.robot.table, row.where.link);
    if (row.place.share < 1.0) put(w, count, 1.0 - row.place.share, slope);
    put(w + 1, count, row.place.share, slope);
  }
  for (const StepRow& row : rows_.step) {
    const Index w = static_cast<Index>(row.interval), k = static_cast<Index>(row.theta);
    if (variable_[w][k] >= 0) *out++ = -1.0;
    if (variable_[w + 1][k] >= 0) *out++ = 1.0;
  }
  for (const CableRow& row : rows_.cable) {
    const Index w = static_cast<Index>(row.interval), c = static_cast<Index>(row.cable);
    const auto slope = [&](Index at) {
      return [&, at](Index k) { return first(cables_[at].by_segment_m[c][k / 2], k % 2); };
    };
    const Index count = 2 * cables_[w].by_segment_m[c].size();
    put(w, count, -1.0, slope(w));
    put(w + 1, count, 1.0, slope(w + 1));
  }
  std::array<ThetaVector, kMaxCables> slope{};
  for (Index i = 0; i < rows_.tension.size(); ++i) {
    const TensionRow& row = rows_.tension[i];
    const Index w = static_cast<Index>(row.waypoint);
    if (i == 0 || row.waypoint != rows_.tension[i - 1].waypoint) slope = tension_.by_theta(path_[w]);
    put(w, thetas(), kPer_N, [&](Index k) { return slope[static_cast<Index>(row.cable)][k]; });
  }
}

void PlanProblem::scatter(const PathPlace& place, const ThetaHessian& block, double* out) const {
  const Index w = static_cast<Index>(place.interval);
  const double before = 1.0 - place.share, after = place.share;
  const auto put = [out](std::int32_t position, double value) {
    if (position >= 0) out[position] += value;
  };
  for (Index k = 0; k < thetas(); ++k) {
    for (Index j = 0; j <= k; ++j) put(own_block_[w + 1][k][j], after * after * block[k][j]);
  }
  if (before == 0.0) return;
  for (Index k = 0; k < thetas(); ++k) {
    for (Index j = 0; j <= k; ++j) put(own_block_[w][k][j], before * before * block[k][j]);
    for (Index j = 0; j < thetas(); ++j)
      put(next_block_[w][k][j], before * after * block[std::max(k, j)][std::min(k, j)]);
  }
}

void PlanProblem::add_control_points(double factor, double* out) const {
  for (Index w = 0; w < last(); ++w) {
    ThetaHessian block{};
    for (const ControlPoint& target : request_.control_points) {
      const ArmDerivatives& arm = at_waypoint_[w + 1];
      const ArmPoint where = arm.node(target.node);
      const PointDerivatives node = arm.point(where);
      const NodeDistance distance = node_distance(node.position_m, target.position_m);
      const double weight = factor * target.weight / static_cast<double>(last());
      std::array<Vec3, 3> curvature{};
      for (Index i = 0; i < 3; ++i) {
        curvature[i] = scale(distance.slope, -distance.slope[i] * weight / distance.rounded_m);
        curvature[i][i] += weight / distance.rounded_m;
      }
      add_projected(curvature, node, thetas(), block);
      arm.add_hessian(where, node, scale(distance.slope, weight), block);
    }
    scatter({static_cast<std::int32_t>(w), 1.0}, block, out);
  }
}

void PlanProblem::add_tip_hessian(const double* multipliers, ThetaHessian& block) const {
  const ArmDerivatives& arm = at_waypoint_.back();
  const ArmPoint where = arm.node(request_.robot.table.segment_count);
  arm.add_hessian(where, arm.point(where), {multipliers[0], multipliers[1], multipliers[2]}, block);
  // m . vector(conj(g) q) = (g (0, m)) . q
  const Quat weight = multiply(request_.tip_in_base->quaternion, {0.0, multipliers[3], multipliers[4], multipliers[5]});
  arm.add_quaternion_hessian(weight, block);
}

void PlanProblem::add_cable_hessian(const CableRow& row, double multiplier, double* out) const {
  const Index w = static_cast<Index>(row.interval), c = static_cast<Index>(row.cable);
  for (const Index at : {w, w + 1}) {
    const double factor = at == w ? -multiplier : multiplier;
    for (Index m = 0; m < cables_[at].by_segment_m[c].size(); ++m) {
      for (Index i = 0; i < 2; ++i) {
        for (Index j = 0; j <= i; ++j) {
          const std::int32_t position = own_block_[at][2 * m + i][2 * m + j];
          if (position >= 0) out[position] += factor * second(cables_[at].by_segment_m[c][m], i, j);
        }
      }
    }
  }
}

void PlanProblem::add_tension_hessians(const double* multipliers, double* out) const {
  for (Index i = 0; i < rows_.tension.size();) {
    const std::int32_t w = rows_.tension[i].waypoint;
    CableVector weight{};
    bool pulls = false;
    for (; i < rows_.tension.size() && rows_.tension[i].waypoint == w; ++i) {
      weight[static_cast<Index>(rows_.tension[i].cable)] += kPer_N * multipliers[i];
      pulls = pulls || multipliers[i] != 0.0;
    }
    if (!pulls) continue;
    ThetaHessian block{};
    tension_.add_hessian(path_[static_cast<Index>(w)], weight, block);
    scatter({w - 1, 1.0}, block, out);
  }
}

void PlanProblem::hessian(const double* x, double objective_factor, const double* multipliers, double* out) {
  evaluate(x);
  std::fill(out, out + hessian_.size(), 0.0);
  const double stiffness = objective_factor * static_cast<double>(last());
  for (Index w = 0; w < last(); ++w) {
    for (Index k = 0; k < thetas(); ++k) {
      if (own_block_[w][k][k] >= 0) out[own_block_[w][k][k]] += stiffness;
      if (own_block_[w + 1][k][k] >= 0) out[own_block_[w + 1][k][k]] += stiffness;
      if (next_block_[w][k][k] >= 0) out[next_block_[w][k][k]] -= stiffness;
    }
  }
  add_control_points(objective_factor, out);
  if (has_tip()) {
    ThetaHessian block{};
    add_tip_hessian(multipliers, block);
    scatter({static_cast<std::int32_t>(last()) - 1, 1.0}, block, out);
  }
  for (Index i = 0; i < rows_.clearance.size();) {
    const Index place = place_of_row_[i];
    const ArmDerivatives& arm = at_place_[place];
    ThetaHessian block{};
    for (; i < rows_.clearance.size() && place_of_row_[i] == place; ++i) {
      const ClearanceRow& row = rows_.clearance[i];
      const double multiplier = multipliers[first_clearance_ + i];
      if (multiplier == 0.0) continue;
      const PointDerivatives point = arm.point(row.where);
      const PointDistance distance = row_distance(row, point.position_m, request_.scene);
      add_projected(scaled(distance.curvature, multiplier), point, thetas_before(request_.robot.table, row.where.link),
                    block);
      arm.add_hessian(row.where, point, scale(distance.normal, multiplier), block);
    }
    scatter(places_[place], block, out);
  }
  for (Index i = 0; i < rows_.cable.size(); ++i) add_cable_hessian(rows_.cable[i], multipliers[first_cable_ + i], out);
  add_tension_hessians(multipliers + first_tension_, out);
}

}  // namespace liana::planner
