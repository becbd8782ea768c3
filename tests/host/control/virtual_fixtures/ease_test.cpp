// A hand at joint limits and near the straight arm: slower on the way there, never on the way out.
#include "host/control/virtual_fixtures/ease.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::virtual_fixtures {
namespace {

const RobotParams kRobot = zhu2022::table();
constexpr std::uint32_t kPlanar = 1u << 6 | 1u << 8;  // X4 and X5

// The tip after all angles have gone this far on a line from theta.
Pose tip_after(const ThetaVector& theta_rad, std::size_t k, double way_rad) {
  ThetaVector ahead = theta_rad;
  ahead[k] += way_rad;
  return forward_kinematics(kRobot, ahead).tip_in_base;
}

TEST(Ease, IsNoneAtThePosesOfTheMissionWhicheverWayTheHandGoes) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  for (const auto& pose : {zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg}) {
    const ThetaVector theta = zhu2022::radians(pose);
    for (int i = 0; i < 50; ++i) {
      Pose goal = forward_kinematics(kRobot, theta).tip_in_base;
      goal.position_m = add(goal.position_m, {0.1 * one(random), 0.1 * one(random), 0.1 * one(random)});
      EXPECT_EQ(ease(kRobot, theta, kPlanar, goal).share, 1.0);
    }
  }
}

TEST(Ease, SlowsTheWayToAJointLimitByHowNearItIsAndNamesTheAngle) {
  ThetaVector theta = zhu2022::radians(zhu2022::kPressRod_deg);
  double before = 1.0;
  for (const double left_deg : {3.0, 1.5, 1.0, 0.5, 0.0}) {
    theta[9] = (20.0 - left_deg) * kDegree;
    const Ease to = ease(kRobot, theta, kPlanar, tip_after(theta, 9, 0.01));
    EXPECT_LE(to.share, before);
    EXPECT_EQ(to.share < 1.0, left_deg < 2.0) << left_deg;
    if (to.share < 1.0) {
      EXPECT_EQ(to.theta, 10) << left_deg;
    }
    before = to.share;
  }
  EXPECT_NEAR(before, kMinShare, 1e-9) << "never stuck";
}

TEST(Ease, LeavesTheWayBackFromALimitAsFastAsEver) {
  for (const std::size_t k : {0u, 3u, 5u, 9u}) {
    ThetaVector theta = zhu2022::radians(zhu2022::kPressRod_deg);
    theta[k] = 20.0 * kDegree;
    ThetaVector back = theta;
    back[k] -= 0.01;
    const Ease out = ease(kRobot, theta, kPlanar, forward_kinematics(kRobot, back).tip_in_base);
    EXPECT_NE(out.theta, static_cast<std::int32_t>(k) + 1) << "theta " << k + 1;
  }
}

TEST(Ease, OfAGoalThatIsReachedIsNone) {
  ThetaVector theta{};
  theta[0] = 20.0 * kDegree;
  EXPECT_EQ(ease(kRobot, theta, 0, forward_kinematics(kRobot, theta).tip_in_base).share, 1.0);
}

}  // namespace
}  // namespace liana::virtual_fixtures
