#include "host/planning/planner/check/way_check.hpp"

#include <algorithm>

#include "host/model/clearance/free_part.hpp"
#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::planner {
namespace {

constexpr double kLetOut = 1.02;      // of the tension that it stands with, on the way to less
constexpr double kRounding_m = 1e-6;  // of points that became degrees in between

struct Allowed {
  double clearance_m;
  double self_m;
  double ceiling_N;
};

std::string refusal(const config::RobotConfig& robot, const config::SceneConfig& scene,
                    const std::vector<ThetaVector>& way, const Allowed& allowed) {
  const PlanCheck check = check_plan(robot, scene, way, plain_tip(robot.table, way.back()));
  if (check.min_clearance_m < allowed.clearance_m - kRounding_m) {
    return text("link %d %s; at least %.2f mm are needed", static_cast<int>(check.nearest_link),
                distance_text(check.min_clearance_m, "'" + check.nearest + "'").c_str(), 1000.0 * allowed.clearance_m);
  }
  if (check.self.clearance_m < allowed.self_m - kRounding_m)
    return text("%s; at least %.2f mm are needed", nearest_text(check.self).c_str(), 1000.0 * allowed.self_m);
  return tension_refusal(robot.table, check, allowed.ceiling_N);
}

// Straight in theta, with points enough for tensions, which are looked at there only.
std::vector<ThetaVector> straight(const ThetaVector& from, const ThetaVector& goal, double share) {
  constexpr std::size_t kPieces = 16;
  std::vector<ThetaVector> way(kPieces + 1, from);
  for (std::size_t k = 0; k <= kPieces; ++k) {
    for (std::size_t i = 0; i < from.size(); ++i)
      way[k][i] += share * static_cast<double>(k) / kPieces * (goal[i] - from[i]);
  }
  return way;
}

}  // namespace

std::string refusal_of_way(const config::RobotConfig& robot, const config::SceneConfig& scene,
                           const std::vector<ThetaVector>& points, double margin_m, double off_m) {
  const Allowed allowed{margin_m, std::max(kSelfMargin_m, 2.0 * off_m), robot.table.tension.ceiling_free_N};
  const Allowed on_lead{2.0 * off_m, allowed.self_m, allowed.ceiling_N};
  const std::string lead = refusal(robot, scene, {points[0], points[1]}, on_lead);
  if (!lead.empty()) return "between where the arm stands and point 1 " + lead;
  const std::string whole = refusal(robot, scene, {points.begin() + 1, points.end()}, allowed);
  if (whole.empty()) return {};
  for (std::size_t k = 1; k + 1 < points.size(); ++k) {
    const std::string piece = refusal(robot, scene, {points[k], points[k + 1]}, allowed);
    if (!piece.empty()) return text("between points %d and %d ", static_cast<int>(k), static_cast<int>(k + 1)) + piece;
  }
  return whole;
}

std::string refusal_of_move(const config::RobotConfig& robot, const config::SceneConfig& scene, const ThetaVector& from,
                            const ThetaVector& goal) {
  const PlanCheck stands = check_plan(robot, scene, {from}, plain_tip(robot.table, from));
  const Allowed allowed{std::min(scene.margins.prediction_m + scene.margins.refuse_m, stands.min_clearance_m),
                        std::min(kSelfMargin_m, stands.self.clearance_m),
                        std::max(robot.table.tension.ceiling_free_N, kLetOut * stands.max_tension_N)};
  const clearance::FreePart part =
      clearance::free_part([&](double share) { return refusal(robot, scene, straight(from, goal, share), allowed); });
  if (part.refusal.empty()) return {};
  return text("after %d %% of the straight way in the joint angles ", static_cast<int>(100.0 * part.share)) +
         part.refusal;
}

}  // namespace liana::planner
