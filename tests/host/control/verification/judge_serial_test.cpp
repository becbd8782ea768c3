// What the second end refuses of a serial arm's simulated motion: bodies, itself, and what its drives are told.
#include "host/control/verification/judge_serial.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware_like/micro_arm.hpp"
#include "tests/message.hpp"

namespace liana::verification {
namespace {

using serial::JointVector;

constexpr double kRadius_m = 0.15, kPrediction_m = 0.009;

// The bent arm beside a ball that its tip goes towards, or away from, along a straight line in joint space.
class ASerialArmBesideABall : public testing::Test {
 protected:
  // The ball is so far off the arm's surface at the pose where joint 1 is turned by `turned_deg`, on the side that the
  // tip goes to as that joint turns on.
  void ball_at(double turned_deg, double off_m) {
    JointVector joint_rad = bent_;
    joint_rad[0] += turned_deg * kDegree;
    const Vec3 tip_m = simulation::serial_axis(model_.table, joint_rad).tip_m();
    const Vec3 ahead = scale({-tip_m[1], tip_m[0], 0.0}, 1.0 / std::hypot(tip_m[0], tip_m[1]));
    double near_m = 0.2, far_m = 3.0;
    for (int i = 0; i < 60; ++i) {
      const double middle_m = 0.5 * (near_m + far_m);
      scene_.spheres = {{"ball", add(tip_m, scale(ahead, middle_m)), 0.1}};
      simulation::SerialSimulation simulation(model_, scene_);
      const double here_m = simulation.run(joint_rad, {0.02, {joint_rad, joint_rad}}).distances.scene.distance_m;
      (here_m < off_m ? near_m : far_m) = middle_m;
    }
    scene_.margins.prediction_m = kPrediction_m;
  }

  SimulationVerdict turns(double from_deg, double to_deg, std::size_t rows = 200) {
    simulation::ToldRows<JointVector> told{0.02, {}};
    for (std::size_t row = 0; row < rows; ++row) {
      told.rows_rad.push_back(bent_);
      told.rows_rad.back()[0] +=
          (from_deg + (to_deg - from_deg) * static_cast<double>(row) / static_cast<double>(rows - 1)) * kDegree;
    }
    return judged(told);
  }

  SimulationVerdict judged(const simulation::ToldRows<JointVector>& told) {
    simulation::SerialSimulation simulation(model_, scene_);
    SimulationVerdict verdict;
    verdict.margins = margins_unknown();
    judge_serial(model_.table, simulation, told, simulation.run(told.rows_rad.front(), told), too_near_, verdict);
    return verdict;
  }

  simulation::SerialModel model_{serial::micro::table(), kRadius_m, {}, {}, ""};
  config::SceneConfig scene_;
  JointVector bent_ = serial::micro::radians(serial::micro::kBent_deg);
  TooNear too_near_;
};

// req:C8
TEST_F(ASerialArmBesideABall, MayNotComeNearerThanWhatIsCertain) {
  ball_at(0.0, kPrediction_m + 0.0007);
  EXPECT_EQ(turns(0.0, 0.0).code, Refusal::kNone);
  ball_at(0.5, kPrediction_m - 0.0007);
  too_near_.forget();
  const SimulationVerdict verdict = turns(-5.0, 0.5, 400);
  EXPECT_EQ(verdict.code, Refusal::kSceneContact);
  EXPECT_NE(verdict.text.find("ball (link 7)"), std::string::npos) << verdict.text;
  EXPECT_EQ(verdict.first.body, "ball (link 7)");
}

TEST_F(ASerialArmBesideABall, ThatIsTooNearAlreadyMayGoAway) {
  ball_at(0.0, 0.0);
  EXPECT_EQ(turns(0.0, -2.0).code, Refusal::kNone);
  too_near_.forget();
  ball_at(1.0, -0.02);
  EXPECT_EQ(turns(0.0, 1.0).code, Refusal::kSceneContact);
}

TEST_F(ASerialArmBesideABall, IsToldToGoSlowlyWhereTheSceneSaysSo) {
  scene_.margins.slow_m = 0.05;
  ball_at(0.0, 0.04);
  const SimulationVerdict verdict = turns(0.0, 0.0);
  EXPECT_TRUE(verdict.passed());
  EXPECT_TRUE(verdict.slowly);
  EXPECT_NEAR(verdict.margins.clearance_m, 0.04 - kPrediction_m, 1e-9);
}

TEST_F(ASerialArmBesideABall, WithoutABodyNothingIsSaidOfClearance) {
  const SimulationVerdict verdict = turns(0.0, 1.0);
  EXPECT_TRUE(verdict.passed());
  EXPECT_TRUE(std::isnan(verdict.margins.clearance_m));
  EXPECT_NEAR(verdict.margins.joint_deg, 270.0 - 139.0, 1e-6) << "joint 4 is nearest to an end of its range";
  EXPECT_TRUE(verdict.first.body.empty());
}

// req:C8
TEST_F(ASerialArmBesideABall, MayNotTouchItself) {
  simulation::ToldRows<JointVector> told{0.02, {}};
  for (int row = 0; row <= 400; ++row)
    told.rows_rad.push_back(serial::micro::radians({0, 0, 0, 150.0 + 0.075 * row, 0, 0, 0}));
  const SimulationVerdict verdict = judged(told);
  EXPECT_EQ(verdict.code, Refusal::kSelfContact);
  EXPECT_TRUE(names(verdict.text, {"arm", "itself", "link 3"}));
}

TEST_F(ASerialArmBesideABall, ThatTouchesItselfAlreadyMayUnfoldAndNotFoldOn) {
  const auto bends = [this](std::size_t joint, double from_deg, double to_deg) {
    simulation::ToldRows<JointVector> told{0.02, {}};
    for (int row = 0; row <= 100; ++row) {
      told.rows_rad.push_back(bent_);
      told.rows_rad.back()[joint] = (from_deg + (to_deg - from_deg) * row / 100.0) * kDegree;
    }
    return judged(told).code;
  };
  bent_ = serial::micro::radians({0, 90, 60, 178, 0, 0, 0});
  EXPECT_EQ(bends(3, 178.0, 178.0), Refusal::kNone) << "it may stand";
  EXPECT_EQ(bends(3, 178.0, 176.0), Refusal::kNone);
  EXPECT_EQ(bends(6, 0.0, 2.0), Refusal::kNone) << "a roll of the last link brings nothing nearer";
  EXPECT_EQ(bends(3, 178.0, 180.0), Refusal::kSelfContact);
}

TEST_F(ASerialArmBesideABall, AngleAndRateThatDrivesAreToldAreHeldAgainstTheTable) {
  bent_[0] = 269.0 * kDegree;
  EXPECT_EQ(turns(0.0, 0.999).code, Refusal::kNone);
  const SimulationVerdict beyond = turns(0.0, 1.001);
  EXPECT_EQ(beyond.code, Refusal::kJointAngle);
  EXPECT_EQ(beyond.first.body, "joint 1");
  bent_ = {};
  EXPECT_EQ(turns(0.0, 3.95 * 0.02 * 19, 20).code, Refusal::kTipSpeed) << "the stretched arm is too long for 4 deg/s";
  EXPECT_EQ(turns(0.0, 4.05 * 0.02 * 19, 20).code, Refusal::kJointRate);
}

TEST_F(ASerialArmBesideABall, ANumberThatIsNoneIsRefused) {
  simulation::ToldRows<JointVector> told{0.02, {bent_, bent_, bent_}};
  told.rows_rad[1][2] = std::nan("");
  EXPECT_FALSE(judged(told).passed());
}

// Folded back on itself from the start: unfolding is let through, and said.
TEST_F(ASerialArmBesideABall, ThatTouchesItselfFromTheStartIsLedApartAndItIsSaid) {
  scene_.spheres.clear();
  simulation::ToldRows<JointVector> told{0.02, {}};
  for (int row = 0; row < 200; ++row)
    told.rows_rad.push_back(serial::micro::radians({0, 0, 0, 180 - 0.02 * row, 0, 0, 0}));
  const SimulationVerdict apart = judged(told);
  EXPECT_EQ(apart.code, Refusal::kNone) << apart.text;
  EXPECT_EQ(apart.touches_itself, "link 3 (link 4)");
  told.rows_rad.assign(2, bent_);
  EXPECT_EQ(judged(told).touches_itself, "");
}

// req:C8
TEST_F(ASerialArmBesideABall, AWholeWayIsRefusedWhereAPieceOfItComesTooNearAndItIsSaidHowFarOn) {
  ball_at(20.0, kPrediction_m + 0.001);
  const auto turned = [this](double joint_1_deg, double joint_4_deg = 0.0) {
    JointVector joint_rad = bent_;
    joint_rad[0] += joint_1_deg * kDegree;
    joint_rad[3] += joint_4_deg * kDegree;
    return joint_rad;
  };
  const auto refusal = [&](const std::vector<JointVector>& points_rad) {
    simulation::SerialSimulation simulation(model_, scene_);
    return refusal_of_way(model_.table, simulation, points_rad, false);
  };
  EXPECT_EQ(refusal({turned(0.0), turned(20.0)}), "");
  EXPECT_EQ(refusal({turned(0.0), turned(0.0)}), "") << "no way";
  EXPECT_TRUE(names(refusal({turned(0.0), turned(40.0)}), {"after 50 %", "ball (link 7)"})) << "half is free";
  EXPECT_TRUE(names(refusal({turned(0.0), turned(20.0), turned(40.0)}), {"points 1 and 2", "ball (link 7)"}));
  EXPECT_EQ(refusal({turned(20.0), turned(0.0), turned(0.0, -60.0)}), "") << "away from it";

  scene_.spheres.clear();
  JointVector folded = bent_;
  folded[3] = 180.0 * kDegree;
  EXPECT_TRUE(names(refusal({bent_, folded}), {"itself", "link 4"}));
  EXPECT_EQ(refusal({folded, bent_}), "") << "it unfolds";
}

}  // namespace
}  // namespace liana::verification
