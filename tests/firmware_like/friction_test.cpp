// Planned slip and capstan friction.
#include "firmware_like/cable/arm/friction.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

struct Arm {
  RobotParams robot = zhu2022::table();
  CableLayout layout = cable_layout(robot);
  CableGeometry at(const ThetaVector& theta) const { return cable_geometry(robot, layout, arm_trig(robot, theta)); }
  TensionRatio ratio(const ThetaVector& theta, const SlipState& slip) const {
    return tension_ratio(robot, layout, arm_trig(robot, theta), slip);
  }
};

// Slip after a straight way from `from` to `to` in `steps` ticks.
SlipState slip_along(const Arm& arm, const ThetaVector& from, const ThetaVector& to, std::int32_t steps,
                     SlipState slip = {}) {
  slip.part_m = arm.at(from).part_m;
  for (std::int32_t i = 1; i <= steps; ++i) {
    advance_slip(arm.layout, arm.at(zhu2022::plus(from, zhu2022::plus(to, from, -1.0), static_cast<double>(i) / steps)),
                 slip);
  }
  return slip;
}

double largest_slip_difference(const SlipState& a, const SlipState& b) {
  double largest = 0.0;
  for (std::size_t c = 0; c < kMaxCables; ++c)
    largest = std::max(largest, zhu2022::largest_difference(a.sigma[c], b.sigma[c]));
  return largest;
}

TEST(Friction, StandingStillChangesNoSlip) {
  const Arm arm;
  const ThetaVector pose = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const SlipState before = slip_along(arm, ThetaVector{}, pose, 200);
  EXPECT_EQ(largest_slip_difference(slip_along(arm, pose, pose, 100, before), before), 0.0);
}

TEST(Friction, LongOneWayMotionSlidesEveryCableTheWayItsPathChanges) {
  const Arm arm;
  ThetaVector pitched{};
  pitched[8] = 10.0 * kDegree;  // only the last segment bends: its own cables are the ones that move
  const CableGeometry straight = arm.at(ThetaVector{}), bent = arm.at(pitched);
  const SlipState slip = slip_along(arm, ThetaVector{}, pitched, 500);
  for (std::size_t c = 12; c < 15; ++c) {
    const bool shrinks = bent.length_m[c] < straight.length_m[c];
    for (std::size_t j = 0; j < 5; ++j) EXPECT_NEAR(slip.sigma[c][j], shrinks ? 1.0 : -1.0, 0.01) << c << " " << j;
  }
  for (std::size_t c = 0; c < 12; ++c) {
    for (double sigma : slip.sigma[c]) EXPECT_EQ(sigma, 0.0) << c;
  }
}

TEST(Friction, SlipStaysWithinOneOnAnyPath) {
  const Arm arm;
  Random random(1);
  SlipState slip;
  ThetaVector from{};
  for (std::int32_t i = 0; i < 200; ++i) {
    const ThetaVector to = random.theta(arm.robot, 20.0);
    slip = slip_along(arm, from, to, i % 2 == 0 ? 1 : 20, slip);  // also jumps of one tick
    for (const auto& row : slip.sigma) {
      for (double sigma : row) ASSERT_LE(std::fabs(sigma), 1.0);
    }
    from = to;
  }
}

// Capstan friction knows no rate: only the way counts.
TEST(Friction, SlipDependsOnTheWayAndNotOnTheTicksItTakes) {
  const Arm arm;
  Random random(2);
  for (std::int32_t i = 0; i < 20; ++i) {
    const ThetaVector from = random.theta(arm.robot, 15.0);
    const ThetaVector to = zhu2022::plus(from, random.theta(arm.robot, 0.05));
    const SlipState fast = slip_along(arm, from, to, 200), slow = slip_along(arm, from, to, 800);
    ASSERT_LE(largest_slip_difference(fast, slow), 5e-3);
    ASSERT_GT(largest_slip_difference(fast, SlipState{}), 0.02);
  }
}

// Only the last segment bends, by as much up as down: what slips one way slips as much the other way.
TEST(Friction, SlipOfEitherWayMirrorsTheOthers) {
  const Arm arm;
  ThetaVector up{}, down{};
  up[8] = 0.05 * kDegree;
  down[8] = -up[8];
  const SlipState a = slip_along(arm, ThetaVector{}, up, 50), b = slip_along(arm, ThetaVector{}, down, 50);
  for (std::size_t c = 12; c < 15; ++c) {
    for (std::size_t j = 0; j < 5; ++j) {
      EXPECT_NEAR(a.sigma[c][j], -b.sigma[c][j], 1e-3) << c << " " << j;
      EXPECT_GT(std::fabs(a.sigma[c][j]), 0.02) << c << " " << j;
      EXPECT_LT(std::fabs(a.sigma[c][j]), 0.98) << c << " " << j;
    }
  }
}

TEST(Friction, FadingTakesAShareOfEveryCablesSlipUpToItsOwnSegment) {
  const Arm arm;
  SlipState slip;
  for (std::size_t c = 0; c < kMaxCables; ++c) slip.sigma[c].fill(0.01 * static_cast<double>(c + 1));
  fade_slip(arm.layout, 0.25, slip);
  for (std::size_t c = 0; c < kMaxCables; ++c) {
    for (std::size_t j = 0; j < slip.sigma[c].size(); ++j)
      EXPECT_NEAR(slip.sigma[c][j], 0.01 * static_cast<double>(c + 1) * (c < 15 && j <= c / 3 ? 0.75 : 1.0), 1e-15);
  }
}

TEST(Friction, ReversalGoesThroughPreslidingInsteadOfJumping) {
  const Arm arm;
  ThetaVector far{}, back{};
  far[8] = 10.0 * kDegree;
  back[8] = 9.999 * kDegree;
  const SlipState there = slip_along(arm, ThetaVector{}, far, 1000);
  const SlipState turned = slip_along(arm, far, back, 1, there);
  EXPECT_GT(largest_slip_difference(there, turned), 1e-3);
  EXPECT_LT(largest_slip_difference(there, turned), 0.1);
}

TEST(Friction, WithoutFrictionTensionIsTheSameEverywhere) {
  Arm arm;
  arm.robot.friction_mu = 0.0;
  const ThetaVector pose = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const TensionRatio ratio = arm.ratio(pose, slip_along(arm, ThetaVector{}, pose, 100));
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    for (std::size_t j = 0; j <= c / 3; ++j) EXPECT_EQ(ratio[c][j], 1.0);
  }
}

TEST(Friction, RatioIsTheCapstanLawUpToTheMiddleOfEachSegment) {
  const Arm arm;
  Random random(3);
  const ThetaVector theta = random.theta(arm.robot, 20.0);
  const SegmentVector wrap_rad = cable_wraps(arm.robot, arm_trig(arm.robot, theta));
  SlipState slip;
  for (auto& row : slip.sigma) {
    for (double& sigma : row) sigma = random.uniform(-1.0, 1.0);
  }
  const TensionRatio ratio = arm.ratio(theta, slip);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    double turned = 0.0;
    for (std::size_t j = 0; j <= c / 3; ++j) {
      const double bend = slip.sigma[c][j] * wrap_rad[j];
      EXPECT_NEAR(ratio[c][j], std::exp(-zhu2022::kMu * (turned + 0.5 * bend)), 1e-12);
      turned += bend;
    }
  }
}

}  // namespace
}  // namespace liana::cable
