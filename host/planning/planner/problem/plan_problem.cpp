#include "host/planning/planner/problem/plan_problem.hpp"

#include <algorithm>

namespace liana::planner {
namespace {

constexpr std::int32_t kTipRows = 6;

}  // namespace

std::size_t thetas_before(const RobotParams& table, std::int32_t link) {
  std::size_t m = 0;
  for (std::int32_t links = 0; m < static_cast<std::size_t>(table.segment_count); ++m) {
    links += table.segment[m].modules;
    if (link < links) break;
  }
  return 2 * (m + 1);
}

ThetaVector theta_at(const Path& path, const PathPlace& place) {
  const std::size_t w = static_cast<std::size_t>(place.interval);
  ThetaVector theta{};
  for (std::size_t k = 0; k < theta.size(); ++k)
    theta[k] = (1.0 - place.share) * path[w][k] + place.share * path[w + 1][k];
  return theta;
}

bool is_held(const HeldPhase& phase, std::int32_t waypoint, std::int32_t waypoints) {
  return waypoint >= phase.from_share * (waypoints - 1) - 1e-9;
}

PlanProblem::PlanProblem(const PlanRequest& request, const Path& path, const PlanRows& rows, double clearance_m,
                         double stride_rad)
    : request_(request), stride_rad_(stride_rad), base_(path), tension_(request.robot.table), rows_(rows) {
  std::stable_sort(rows_.clearance.begin(), rows_.clearance.end(), [](const ClearanceRow& a, const ClearanceRow& b) {
    return a.place.interval != b.place.interval ? a.place.interval < b.place.interval : a.place.share < b.place.share;
  });
  for (const ClearanceRow& row : rows_.clearance) {
    if (places_.empty() || !(places_.back() == row.place)) places_.push_back(row.place);
    place_of_row_.push_back(places_.size() - 1);
  }
  number_variables();
  build_bounds(clearance_m);
  build_jacobian();
  build_hessian();
}

void PlanProblem::number_variables() {
  const std::int32_t count = static_cast<std::int32_t>(base_.size());
  ThetaIndex none;
  none.fill(-1);
  variable_.assign(base_.size(), none);
  for (Index w = 1; w <= last(); ++w) {
    if (w == last() && !has_tip()) break;
    for (Index k = 0; k < thetas(); ++k) {
      const bool held = std::any_of(request_.held.begin(), request_.held.end(), [&](const HeldPhase& phase) {
        return static_cast<Index>(phase.theta) == k && is_held(phase, static_cast<std::int32_t>(w), count);
      });
      if (held) continue;
      variable_[w][k] = variables();
      const double limit = request_.robot.table.segment[k / 2].theta_limit_rad;
      start_.push_back(std::clamp(base_[w][k], -limit, limit));
      lower_.push_back(std::max(-limit, start_.back() - stride_rad_));
      upper_.push_back(std::min(limit, start_.back() + stride_rad_));
    }
  }
}

void PlanProblem::build_bounds(double clearance_m) {
  constexpr double kUnbounded = 1e19;
  const auto rows = [this](Index count, double low, double high) {
    constraint_lower_.insert(constraint_lower_.end(), count, low);
    constraint_upper_.insert(constraint_upper_.end(), count, high);
  };
  if (has_tip()) rows(kTipRows, 0.0, 0.0);
  first_clearance_ = constraint_lower_.size();
  rows(rows_.clearance.size(), clearance_m + request_.robot.module_radius_m, kUnbounded);
  first_step_ = constraint_lower_.size();
  rows(rows_.step.size(), -request_.max_step_rad, request_.max_step_rad);
  first_cable_ = constraint_lower_.size();
  rows(rows_.cable.size(), -request_.max_cable_step_m(), request_.max_cable_step_m());
  first_tension_ = constraint_lower_.size();
  const TensionLimits& tension = request_.robot.table.tension;
  rows(rows_.tension.size(), 1e-3 * (tension.floor_motor_N + kInnerTension_N),
       1e-3 * (tension.ceiling_free_N - kInnerTension_N));
}

const char* PlanProblem::constraint_kind(std::int32_t row) const {
  const Index i = static_cast<Index>(row);
  if (i < first_clearance_) return "tip";
  if (i < first_step_) return "clearance";
  if (i < first_cable_) return "step";
  return i < first_tension_ ? "cable" : "tension";
}

void PlanProblem::add_jacobian_row(std::int32_t row, Index waypoint, Index count) {
  for (Index k = 0; k < count; ++k) {
    if (variable_[waypoint][k] >= 0) jacobian_.push_back({row, variable_[waypoint][k]});
  }
}

void PlanProblem::build_jacobian() {
  std::int32_t row = 0;
  if (has_tip()) {
    for (; row < kTipRows; ++row) add_jacobian_row(row, last(), thetas());
  }
  for (const ClearanceRow& clearance : rows_.clearance) {
    const Index w = static_cast<Index>(clearance.place.interval),
                count = thetas_before(request_.robot.table, clearance.where.link);
    if (clearance.place.share < 1.0) add_jacobian_row(row, w, count);
    add_jacobian_row(row++, w + 1, count);
  }
  for (const StepRow& step : rows_.step) {
    const Index w = static_cast<Index>(step.interval), k = static_cast<Index>(step.theta);
    for (const Index at : {w, w + 1}) {
      if (variable_[at][k] >= 0) jacobian_.push_back({row, variable_[at][k]});
    }
    ++row;
  }
  const std::vector<std::vector<Jet>> cables = cable_derivatives(request_.robot.table, ThetaVector{}).by_segment_m;
  for (const CableRow& cable : rows_.cable) {
    const Index w = static_cast<Index>(cable.interval), count = 2 * cables[static_cast<Index>(cable.cable)].size();
    add_jacobian_row(row, w, count);
    add_jacobian_row(row++, w + 1, count);
  }
  for (const TensionRow& tension : rows_.tension)
    add_jacobian_row(row++, static_cast<Index>(tension.waypoint), thetas());
}

std::int32_t PlanProblem::add_hessian_entry(std::int32_t a, std::int32_t b) {
  if (a < 0 || b < 0) return -1;
  hessian_.push_back({std::max(a, b), std::min(a, b)});
  return static_cast<std::int32_t>(hessian_.size()) - 1;
}

void PlanProblem::build_hessian() {
  ThetaIndex none;
  none.fill(-1);
  ThetaBlock empty;
  empty.fill(none);
  own_block_.assign(base_.size(), empty);
  next_block_.assign(base_.size(), empty);
  std::vector<bool> coupled(base_.size(), false);  // by a clearance between waypoints
  for (const PathPlace& place : places_) {
    if (place.share < 1.0) coupled[static_cast<Index>(place.interval)] = true;
  }
  for (Index w = 0; w <= last(); ++w) {
    for (Index k = 0; k < thetas(); ++k) {
      for (Index j = 0; j <= k; ++j) own_block_[w][k][j] = add_hessian_entry(variable_[w][k], variable_[w][j]);
      if (w == last()) continue;
      for (Index j = 0; j < thetas(); ++j) {
        if (j == k || coupled[w]) next_block_[w][k][j] = add_hessian_entry(variable_[w + 1][k], variable_[w][j]);
      }
    }
  }
}

Path PlanProblem::path_of(const double* x) const {
  Path path = base_;
  for (Index w = 0; w <= last(); ++w) {
    for (Index k = 0; k < thetas(); ++k) {
      if (variable_[w][k] >= 0) path[w][k] = x[variable_[w][k]];
    }
  }
  return path;
}

}  // namespace liana::planner
