#include "host/planning/planner/plan_refusal.hpp"

#include "firmware_like/math/trig.hpp"
#include "host/planning/planner/text.hpp"

namespace liana::planner {
namespace {

constexpr double kTipTolerance = 1e-6;  // m and rad

}  // namespace

std::optional<PlanRefusal> refusal_of(const PlanRequest& request, const PlanCheck& check) {
  if (check.min_clearance_m < request.margin_m) {
    return PlanRefusal{
        PlanOutcome::limit, "clearance",
        text("on the path found link %d %s; the margin is %.2f mm", static_cast<int>(check.nearest_link),
             distance_text(check.min_clearance_m, "'" + check.nearest + "'").c_str(), 1000.0 * request.margin_m)};
  }
  if (check.self.clearance_m < kSelfMargin_m) {
    return PlanRefusal{
        PlanOutcome::limit, "self",
        text("on the path found %s; the margin is %.2f mm", nearest_text(check.self).c_str(), 1000.0 * kSelfMargin_m)};
  }
  if (check.over_limit_deg > 0.0)
    return PlanRefusal{PlanOutcome::limit, "limits", text("a theta is %.2g deg over its limit", check.over_limit_deg)};
  if (check.max_step_deg * kDegree > request.max_step_rad + kStepTolerance) {
    return PlanRefusal{PlanOutcome::limit, "step",
                       text("a theta changes by %.6f deg in a step; allowed are %.6f deg", check.max_step_deg,
                            request.max_step_rad / kDegree)};
  }
  if (check.max_cable_step_m > request.max_cable_step_m() + kStepTolerance) {
    return PlanRefusal{PlanOutcome::limit, "cable",
                       text("a cable changes by %.6f mm in a step; allowed are %.6f mm",
                            1000.0 * check.max_cable_step_m, 1000.0 * request.max_cable_step_m())};
  }
  if (check.tip_error_m > kTipTolerance || check.tip_attitude_error_rad > kTipTolerance) {
    return PlanRefusal{PlanOutcome::limit, "tip",
                       text("the tip ends %.2g m and %.2g rad off", check.tip_error_m, check.tip_attitude_error_rad)};
  }
  const RobotParams& table = request.robot.table;
  const std::string tension = tension_refusal(table, check, table.tension.ceiling_free_N);
  if (!tension.empty()) return PlanRefusal{PlanOutcome::infeasible, "tension", tension};
  return {};
}

}  // namespace liana::planner
