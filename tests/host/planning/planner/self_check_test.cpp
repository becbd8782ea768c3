// The arm against itself: poses that curl it up, and paths that pass through such a pose.
#include "host/planning/planner/check/self_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/planning/planner/check/plan_check.hpp"
#include "host/planning/planner/plan_refusal.hpp"
#include "tests/host/planning/planner/requests.hpp"
#include "tests/message.hpp"

namespace liana::planner {
namespace {

// Every pitch and every yaw alike: a circle, or a helix.
ThetaVector curled(double pitch_rad, double yaw_rad) {
  ThetaVector theta{};
  for (std::size_t m = 0; m < 5; ++m) theta[2 * m] = pitch_rad, theta[2 * m + 1] = yaw_rad;
  return theta;
}

double sampled_m(const ThetaVector& theta) {
  const auto end = plain_axis(zhu2022::table(), theta);
  double least_m = 1e3;
  const auto at = [&](std::size_t link, int i) {
    Vec3 p{};
    for (std::size_t x = 0; x < 3; ++x) p[x] = end[link - 1][x] + (end[link][x] - end[link - 1][x]) * i / 20.0;
    return p;
  };
  for (std::size_t a = 1; a < end.size(); ++a) {
    for (std::size_t b = a + 7; b < end.size(); ++b) {  // 7 joints of 20 deg in both directions: half a turn
      for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 20; ++j) least_m = std::min(least_m, norm(subtract(at(a, i), at(b, j))));
      }
    }
  }
  return least_m - 0.06;
}

TEST(SelfCheck, FindsWhatDenseSamplingFinds) {
  zhu2022::Random random(5);
  for (int i = 0; i < 20; ++i) {
    const ThetaVector theta =
        i < 10 ? random.theta(zhu2022::table(), 19.0) : curled(random.uniform(0.2, 0.34), random.uniform(-0.1, 0.1));
    const double found_m = self_clearance(robot_of(zhu2022::table()), theta).clearance_m;
    EXPECT_LE(found_m, sampled_m(theta) + 1e-12);
    EXPECT_GT(found_m, sampled_m(theta) - 0.006) << "samples are 5 mm apart";
  }
}

TEST(SelfCheck, AnArmCurledIntoACircleLiesInItself) {
  const SelfClearance self = self_clearance(robot_of(zhu2022::table()), curled(0.3, 0.0));  // 21 links make a turn
  EXPECT_LT(self.clearance_m, -0.05);
  EXPECT_GE(self.link[1] - self.link[0], 7);
}

// A circle whose end passes the beginning on one side.
ThetaVector twisted(double pitch_rad, double yaw_rad) {
  ThetaVector theta = curled(pitch_rad, 0.0);
  for (std::size_t m = 0; m < 5; ++m) theta[2 * m + 1] = yaw_rad * (static_cast<double>(m) - 2.0);
  return theta;
}

TEST(SelfCheck, FindsACollisionBetweenWaypointsThatAreFree) {
  const ThetaVector left = twisted(0.3, 0.08), right = twisted(0.3, -0.08);
  ASSERT_GT(self_clearance(robot_of(zhu2022::table()), left).clearance_m, 0.02);
  ASSERT_GT(self_clearance(robot_of(zhu2022::table()), right).clearance_m, 0.02);
  EXPECT_LT(self_clearance_along(robot_of(zhu2022::table()), {left, right}).clearance_m, -0.04);
}

TEST(SelfCheck, APlanThroughTheArmItselfIsRefusedByName) {
  PlanRequest request = request_between(zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, {});
  PlanCheck check;
  check.min_clearance_m = kNothingNear_m;
  check.min_tension_N = check.max_tension_N = request.robot.table.tension.plan_N;
  check.self = {-0.012, {3, 24}};
  const auto refused = refusal_of(request, check);
  ASSERT_TRUE(refused);
  EXPECT_STREQ(refused->constraint, "self");
  EXPECT_TRUE(names(refused->reason, {"link 24", "link 3", "12.00 mm", "1.00 mm"}));
}

}  // namespace
}  // namespace liana::planner
