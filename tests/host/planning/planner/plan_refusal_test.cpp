// What the planner refuses of a check's figures.
#include "host/planning/planner/plan_refusal.hpp"

#include "firmware_like/math/trig.hpp"
#include "host/planning/planner/problem/ipopt_solver.hpp"
#include "tests/host/planning/planner/requests.hpp"
#include "tests/message.hpp"

namespace liana::planner {
namespace {

PlanCheck good_check(const PlanRequest& request) {
  PlanCheck check;
  check.min_clearance_m = kNothingNear_m;
  check.min_tension_N = check.max_tension_N = request.robot.table.tension.plan_N;
  return check;
}

TEST(PlanRefusal, AllowsOfAStepWhatTheSolverLeaves) {
  const PlanRequest request = request_between(zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, {});
  PlanCheck check = good_check(request);
  check.max_step_deg = (request.max_step_rad + kConstraintTolerance) / kDegree;
  check.max_cable_step_m = request.max_cable_step_m() + kConstraintTolerance;
  EXPECT_FALSE(refusal_of(request, check));
}

TEST(PlanRefusal, NamesAStepAndWhatIsAllowed) {
  PlanRequest request = request_between(zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, {});
  request.max_step_rad = 2.0 * kDegree;
  PlanCheck theta = good_check(request);
  theta.max_step_deg = 2.0001;
  const auto step = refusal_of(request, theta);
  ASSERT_TRUE(step);
  EXPECT_EQ(step->constraint, std::string("step"));
  EXPECT_TRUE(names(step->reason, {"theta", "2.000100 deg", "2.000000 deg"}));
  PlanCheck wound = good_check(request);
  wound.max_cable_step_m = request.max_cable_step_m() + 1e-6;  // 10 mm/s while theta goes 2 deg at 2 deg/s
  const auto cable = refusal_of(request, wound);
  ASSERT_TRUE(cable);
  EXPECT_EQ(cable->constraint, std::string("cable"));
  EXPECT_TRUE(names(cable->reason, {"cable", "10.001000 mm", "10.000000 mm"}));
}

}  // namespace
}  // namespace liana::planner
