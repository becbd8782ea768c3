// Virtual walls of the scene: no tip passes them, and one that is beyond may come back.
#include <gtest/gtest.h>

#include "host/control/verification/judge_simulated.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/message.hpp"

namespace liana::verification {
namespace {

class ATipBetweenWalls : public testing::Test {
 protected:
  ATipBetweenWalls() {
    rules_.table = cable::zhu2022::table();
    rules_.arm_radius_m = 0.03;
    rules_.scene.fixtures.push_back(
        {"sides", config::FixtureKind::kWalls, {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 2.0, 1.0, 0.05});
  }

  // Of a motion through these places of the tip, off the middle; room is 20 mm.
  SimulationVerdict goes(const std::vector<double>& off_m, double x_m = 2.0) {
    simulation::Motion motion;
    motion.solved = true;
    motion.distances.scene.distance_m = motion.distances.scene_at_start_m = motion.distances.scene_at_end_m = 1.0;
    motion.distances.self.distance_m = 1.0;
    for (const double y_m : off_m) {
      simulation::Moment moment;
      moment.time_s = 0.01 * static_cast<double>(motion.moments.size());
      moment.node_in_base_m[4] = {x_m, y_m, 0.0};
      moment.tension_N.fill(100.0);
      motion.moments.push_back(moment);
    }
    motion.min_passed_share.fill(1.0);
    const simulation::JointSequence told{{0.02, {{}}}, {}, {}};
    return judge_simulated(rules_, told, true, motion, too_near_);
  }

  MotionRules rules_;
  TooNear too_near_;
};

TEST_F(ATipBetweenWalls, ThatWouldPassOneIsRefusedByTheFixturesNameAndWhen) {
  EXPECT_EQ(goes({0.0, 0.0199, -0.0199}).code, Refusal::kNone);
  const SimulationVerdict verdict = goes({0.0, 0.015, 0.0231});
  EXPECT_EQ(verdict.code, Refusal::kFixture);
  EXPECT_TRUE(names(verdict.text, {"sides", "3.1 mm", "0.0 mm"}));
  EXPECT_EQ(verdict.first.body, "sides");
  EXPECT_NEAR(verdict.first.time_s, 0.02, 1e-12);
}

TEST_F(ATipBetweenWalls, IsFreeOutsideTheirLength) { EXPECT_EQ(goes({0.0, 0.5}, 0.9).code, Refusal::kNone); }

TEST_F(ATipBetweenWalls, ThatIsBeyondOneMayComeBackAndGoNoFarther) {
  EXPECT_EQ(goes({0.030, 0.0305, 0.025}).code, Refusal::kNone);
  EXPECT_EQ(goes({0.030, 0.0315}).code, Refusal::kFixture);
}

TEST_F(ATipBetweenWalls, StandsWhereTheSceneIsSeenToStand) {
  rules_.drawing_in_base.position_m = {0.0, 0.01, 0.0};
  EXPECT_EQ(goes({0.0, 0.029}).code, Refusal::kNone);
  EXPECT_EQ(goes({0.0, -0.011}).code, Refusal::kFixture);
}

}  // namespace
}  // namespace liana::verification
