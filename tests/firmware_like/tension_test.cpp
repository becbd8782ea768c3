// Tension plan: balance, floor, ceiling, smoothness; and what a purely geometric command leaves undone (mission, A9;
// physics section 1).
#include "firmware_like/cable/arm/tension.hpp"

#include <gtest/gtest.h>

#include "firmware_like/math/cholesky.hpp"
#include "tests/firmware_like/pose_of_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

struct Planned {
  CableGeometry geometry;
  TensionRatio ratio;
  TensionPlan plan;
};

Planned plan_at(const RobotParams& robot, const ThetaVector& theta, const SlipState& slip) {
  const CableLayout layout = cable_layout(robot);
  Planned out;
  const ArmTrig trig = arm_trig(robot, theta);
  out.geometry = cable_geometry(robot, layout, trig);
  out.ratio = tension_ratio(robot, layout, trig, slip);
  out.plan = plan_tension(robot, out.geometry, out.ratio, SegmentVector{});
  return out;
}

// Torque of all cables on every theta [N m], friction included.
ThetaVector torque_of(const RobotParams& robot, const Planned& at, const CableVector& motor_N) {
  ThetaVector torque{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(robot.cable_count()); ++c) {
    for (std::size_t k = 0; k < kMaxTheta; ++k)
      torque[k] -= at.geometry.jacobian_m_rad[c][k] * at.ratio[c][k / 2] * motor_N[c];
  }
  return torque;
}

double least(const RobotParams& robot, const CableVector& motor_N) {
  return *std::min_element(motor_N.begin(), motor_N.begin() + robot.cable_count());
}

// req:A8
TEST(Tension, TwoThousandPosesAreInBalanceAndOverTheFloorWhateverTheFriction) {
  for (const double mu : {0.0, zhu2022::kMu}) {
    const RobotParams robot = zhu2022::table(mu);
    Random random(1);
    for (std::int32_t i = 0; i < 2000; ++i) {
      const SlipState slip = random_slip(random);  // compilers would take two arguments in either order
      const Planned at = plan_at(robot, random.theta(robot, 20.0), slip);
      ASSERT_TRUE(at.plan.balanced);
      ASSERT_LE(zhu2022::length(torque_of(robot, at, at.plan.motor_N)), 1e-9);
      ASSERT_GE(least(robot, at.plan.motor_N), robot.tension.floor_motor_N);
      const double most = *std::max_element(at.plan.motor_N.begin(), at.plan.motor_N.end());
      ASSERT_EQ(at.plan.ceiling_exceeded, most > robot.tension.ceiling_free_N);
      if (mu == 0.0) {
        ASSERT_LE(most, robot.tension.ceiling_free_N);
      }
      // With every slip at its worst a few extreme poses pass the ceiling of free motion; none comes near the alarm.
      ASSERT_LE(most, 0.5 * robot.tension.alarm_N);
    }
  }
}

TEST(Tension, TheStraightArmIsPulledEvenlyAtThePlannedLevel) {
  const RobotParams robot = zhu2022::table();
  const Planned at = plan_at(robot, ThetaVector{}, SlipState{});
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) EXPECT_NEAR(at.plan.motor_N[c], robot.tension.plan_N, 3.0) << c;
  EXPECT_FALSE(at.plan.floor_acted);
}

TEST(Tension, RaisingTheFloorSaysSo) {
  RobotParams robot = zhu2022::table();
  robot.tension.floor_motor_N = 60.0;  // above the planned level
  const Planned at = plan_at(robot, zhu2022::radians(zhu2022::kPanelEdge_deg), SlipState{});
  EXPECT_TRUE(at.plan.floor_acted);
  EXPECT_GE(least(robot, at.plan.motor_N), 60.0);
  EXPECT_LE(zhu2022::length(torque_of(robot, at, at.plan.motor_N)), 1e-9);
}

TEST(Tension, ACeilingThatIsPassedSaysSo) {
  RobotParams robot = zhu2022::table();
  robot.tension.ceiling_free_N = 41.0;
  EXPECT_TRUE(plan_at(robot, zhu2022::radians(zhu2022::kPanelEdge_deg), SlipState{}).plan.ceiling_exceeded);
}

TEST(Tension, OtherCableCountsAndPhasesBalanceToo) {
  const RobotParams robot = zhu2022::uneven_table();
  Random random(2);
  for (std::int32_t i = 0; i < 500; ++i) {
    const Planned at = plan_at(robot, random.theta(robot, 20.0), random_slip(random));
    ASSERT_TRUE(at.plan.balanced);
    ASSERT_LE(zhu2022::length(torque_of(robot, at, at.plan.motor_N)), 1e-9);
    ASSERT_GE(least(robot, at.plan.motor_N), robot.tension.floor_motor_N);
  }
}

TEST(Tension, CablesThatCannotTurnBothAnglesAreNamedUnbalanced) {
  for (const double apart_rad : {0.0, 1e-7}) {
    RobotParams robot = zhu2022::table();
    robot.segment[2].cable_phase_rad = {0.25 * kPi, 1.25 * kPi, 0.25 * kPi + apart_rad,
                                        0.0};  // all in one plane, or nearly
    EXPECT_FALSE(plan_at(robot, ThetaVector{}, SlipState{}).plan.balanced) << apart_rad;
  }
}

// Tensions follow the pose with a bounded slope, so that no tick asks a motor for a jump: the slope does not grow as
// the steps shrink.
TEST(Tension, PlansAreSmoothAlongRandomPaths) {
  constexpr double kSlope_N_rad = 700.0;
  const RobotParams robot = zhu2022::table();
  const SlipState slip{};
  for (const double step_deg : {0.1, 0.001}) {
    Random random(3);
    for (std::int32_t path = 0; path < 20; ++path) {
      ThetaVector theta = random.theta(robot, 19.0);
      const ThetaVector step = random.theta(robot, step_deg);
      CableVector before = plan_at(robot, theta, slip).plan.motor_N;
      for (std::int32_t i = 0; i < 100; ++i) {
        theta = zhu2022::plus(theta, step);
        const CableVector now = plan_at(robot, theta, slip).plan.motor_N;
        ASSERT_LE(zhu2022::largest_difference(now, before), kSlope_N_rad * zhu2022::length(step));
        before = now;
      }
    }
  }
}

// No kinks either: the second difference falls with the square of the step (a kink's falls with the step).
TEST(Tension, PlansHaveNoKinksAlongRandomPaths) {
  constexpr double kCurvature_N_rad2 = 60000.0;
  const RobotParams robot = zhu2022::table();
  for (std::uint64_t path = 0; path < 60; ++path) {
    Random random(path);
    const ThetaVector from = random.theta(robot, 12.0), step = random.theta(robot, 0.02);
    std::array<CableVector, 3> t{};
    for (std::int32_t i = 0; i < 300; ++i) {
      t = {t[1], t[2], plan_at(robot, zhu2022::plus(from, step, i), SlipState{}).plan.motor_N};
      if (i < 2) continue;
      const CableVector bend = zhu2022::plus(zhu2022::plus(t[0], t[2]), t[1], -2.0);
      ASSERT_LE(zhu2022::length(bend), kCurvature_N_rad2 * zhu2022::length(step) * zhu2022::length(step)) << path;
    }
  }
}

// Tensions that follow from unstretched lengths at a pose, without friction: T = EA (path + lead - payout) / payout.
CableVector tension_from(const RobotParams& robot, const CableGeometry& geometry, const CableVector& payout_m) {
  CableVector tension{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(robot.cable_count()); ++c) {
    tension[c] = robot.cable_EA_N * (geometry.length_m[c] + robot.lead_m - payout_m[c]) / payout_m[c];
  }
  return tension;
}

// Where the arm comes to rest when the motors stand at `payout_m`: Newton on the torque with the elastic stiffness.
ThetaVector rest_pose(const RobotParams& robot, const CableVector& payout_m, ThetaVector theta) {
  for (std::int32_t i = 0; i < 60; ++i) {
    const Planned at = plan_at(robot, theta, SlipState{});
    ThetaVector step = torque_of(robot, at, tension_from(robot, at.geometry, payout_m));
    SquareMatrix<zhu2022::kThetas> stiffness{};
    std::array<double, zhu2022::kThetas> turn{};
    std::copy_n(step.begin(), zhu2022::kThetas, turn.begin());
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      for (std::size_t r = 0; r < zhu2022::kThetas; ++r) {
        for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
          stiffness[r][k] +=
              at.geometry.jacobian_m_rad[c][r] * at.geometry.jacobian_m_rad[c][k] * robot.cable_EA_N / payout_m[c];
        }
      }
    }
    EXPECT_TRUE(cholesky_factor(stiffness));
    cholesky_solve(stiffness, turn);
    std::copy_n(turn.begin(), zhu2022::kThetas, step.begin());
    theta = zhu2022::plus(theta, step);
  }
  return theta;
}

double tip_distance_m(const RobotParams& robot, const ThetaVector& a, const ThetaVector& b) {
  return norm(subtract(forward_kinematics(robot, a).tip_in_base.position_m,
                       forward_kinematics(robot, b).tip_in_base.position_m));
}

TEST(Tension, AGeometricCommandLeavesATorqueThatPlannedTensionsDoNot) {
  const RobotParams robot = zhu2022::table(0.0);
  const CableLayout layout = cable_layout(robot);
  for (const auto& pose : {zhu2022::kPrepare_deg, zhu2022::kPanelEdge_deg, zhu2022::kPressRod_deg}) {
    const ThetaVector theta = zhu2022::radians(pose);
    const Planned at = plan_at(robot, theta, SlipState{});
    CableVector geometric_m{};
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      const double straight_m = layout.zero_length_m[c] + robot.lead_m;
      const double elongation_m = straight_m * robot.tension.plan_N / robot.cable_EA_N;  // the same at every pose
      geometric_m[c] = at.geometry.length_m[c] + robot.lead_m - elongation_m;
    }
    const CableVector planned_m = payout_for(robot, layout, at.geometry.part_m, at.ratio, at.plan.motor_N);

    EXPECT_GT(zhu2022::length(torque_of(robot, at, tension_from(robot, at.geometry, geometric_m))), 0.1);
    EXPECT_LT(zhu2022::length(torque_of(robot, at, tension_from(robot, at.geometry, planned_m))), 1e-8);
    // What that torque does to the tip: millimetres against nothing.
    EXPECT_GT(tip_distance_m(robot, rest_pose(robot, geometric_m, theta), theta), 2e-3);
    EXPECT_LT(tip_distance_m(robot, rest_pose(robot, planned_m, theta), theta), 1e-9);
  }
}

TEST(Tension, PayoutIsShorterThanThePathByWhatTheTensionStretches) {
  const RobotParams robot = zhu2022::table();
  const CableLayout layout = cable_layout(robot);
  const Planned at = plan_at(robot, zhu2022::radians(zhu2022::kPrepare_deg), SlipState{});
  const CableVector slack_m = payout_for(robot, layout, at.geometry.part_m, at.ratio, CableVector{});
  const CableVector tight_m = payout_for(robot, layout, at.geometry.part_m, at.ratio, at.plan.motor_N);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    const double path_m = at.geometry.length_m[c] + robot.lead_m;
    EXPECT_NEAR(slack_m[c], path_m, 1e-14);
    EXPECT_NEAR(path_m - tight_m[c], path_m * at.plan.motor_N[c] / robot.cable_EA_N, 1e-6);
  }
}

// Where friction takes tension away, the cable stretches less and the motor has to give more.
TEST(Tension, PayoutCountsTheStretchOfEveryPieceAtItsOwnTension) {
  const RobotParams robot = zhu2022::table();
  const CableLayout layout = cable_layout(robot);
  SlipState inwards;
  for (auto& row : inwards.sigma) row.fill(1.0);
  const Planned at = plan_at(robot, zhu2022::radians(zhu2022::kPanelEdge_deg), inwards);
  const Planned even = plan_at(robot, zhu2022::radians(zhu2022::kPanelEdge_deg), SlipState{});
  const CableVector payout_m = payout_for(robot, layout, at.geometry.part_m, at.ratio, at.plan.motor_N);
  const CableVector even_m = payout_for(robot, layout, at.geometry.part_m, even.ratio, at.plan.motor_N);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    double unstretched_m = 0.0;
    for (std::size_t j = 0; j <= c / 3; ++j) {
      unstretched_m += at.geometry.part_m[c][j] * at.plan.motor_N[c] * (1.0 - at.ratio[c][j]) / robot.cable_EA_N;
    }
    ASSERT_GT(unstretched_m, 1e-6);
    EXPECT_NEAR(payout_m[c] - even_m[c], unstretched_m, 2e-3 * unstretched_m) << c;
  }
}

const ThetaVector kBent_rad = zhu2022::radians({-8.0, 0.0, -12.0, 0.0, 8.0, -2.0, 13.0, 0.0, 12.0, -2.0});

// A plant in which unknown friction takes `lost_N` off the first cable at its motor.
SegmentVector lifted_until_taut(const RobotParams& robot, double lost_N, CableVector& measured_N) {
  SegmentVector lift_N{};
  const std::int32_t ten_seconds = static_cast<std::int32_t>(10.0 / robot.tick_s);
  const Planned at = plan_at(robot, kBent_rad, SlipState{});
  for (std::int32_t tick = 0; tick < ten_seconds; ++tick) {
    measured_N = plan_tension(robot, at.geometry, at.ratio, lift_N).motor_N;
    measured_N[0] -= lost_N;
    keep_min_tension(robot, measured_N, lift_N);
  }
  return lift_N;
}

TEST(Tension, ASegmentWhoseCableLosesTensionIsPulledTighterAndTurnsNoJoint) {
  const RobotParams robot = zhu2022::table(zhu2022::kMu);
  const Planned at = plan_at(robot, kBent_rad, SlipState{});
  const double lost_N =
      at.plan.motor_N[0] - robot.tension.floor_motor_N - kLiftBelow_N + 5.0;  // 5 N under where lifting starts
  CableVector measured_N{};
  const SegmentVector lift_N = lifted_until_taut(robot, lost_N, measured_N);
  EXPECT_GT(lift_N[0], 4.0);
  EXPECT_GT(measured_N[0], robot.tension.floor_motor_N + kLiftBelow_N - 1.0);
  for (std::size_t j = 1; j < kMaxSegments; ++j) EXPECT_EQ(lift_N[j], 0.0) << j;
  const TensionPlan lifted = plan_tension(robot, at.geometry, at.ratio, lift_N);
  EXPECT_LE(zhu2022::length(torque_of(robot, at, lifted.motor_N)), 1e-9);
}

TEST(Tension, TheLiftIsBoundedAndGoesWhenTheTensionIsBack) {
  const RobotParams robot = zhu2022::table(zhu2022::kMu);
  CableVector measured_N{};
  SegmentVector lift_N = lifted_until_taut(robot, 1000.0, measured_N);
  EXPECT_EQ(lift_N[0], kLiftLimit_N * (1.0 - zhu2022::kMu / kMarginFriction));
  measured_N.fill(robot.tension.plan_N);
  for (double time_s = 0.0; time_s < kLiftLeak_s; time_s += robot.tick_s) keep_min_tension(robot, measured_N, lift_N);
  EXPECT_NEAR(lift_N[0], kLiftLimit_N * (1.0 - zhu2022::kMu / kMarginFriction) * std::exp(-1.0), 0.01);
}

TEST(Tension, WithMuchFrictionNothingIsLifted) {
  CableVector measured_N{};
  EXPECT_EQ(lifted_until_taut(zhu2022::table(0.1), 1000.0, measured_N)[0], 0.0);
}

TEST(Tension, EveryCableThatNearsTheFloorLiftsItsOwnSegment) {
  const RobotParams robot = zhu2022::table();
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    CableVector measured_N;
    measured_N.fill(40.0);
    measured_N[c] = robot.tension.floor_motor_N;
    SegmentVector lift_N{};
    keep_min_tension(robot, measured_N, lift_N);
    for (std::size_t j = 0; j < 5; ++j) EXPECT_EQ(lift_N[j] > 0.0, j == c / 3) << "cable " << c << ", segment " << j;
  }
}

TEST(Tension, ACableNearTheFloorAloneIsWoundInUntilItIsThere) {
  const RobotParams robot = zhu2022::table();
  const double floor_N = robot.tension.floor_motor_N + kTautBelow_N;
  for (const double looser_N : {5.0, 20.0, 55.0, 110.0}) {
    CableVector measured_N, taut_N{};
    for (double time_s = 0.0; time_s < 10.0; time_s += robot.tick_s) {
      measured_N.fill(floor_N);
      measured_N[4] = floor_N - looser_N + taut_N[4];
      wind_in(robot, measured_N, taut_N);
    }
    EXPECT_GT(measured_N[4], floor_N - 2.0) << looser_N;
    EXPECT_LE(measured_N[4], floor_N) << looser_N;
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) EXPECT_EQ(taut_N[c] > 0.0, c == 4) << c;
  }
}

TEST(Tension, WhatACableIsWoundInIsBoundedAndGoesWhenItIsTaut) {
  const RobotParams robot = zhu2022::table();
  CableVector measured_N{}, taut_N{};
  for (double time_s = 0.0; time_s < 10.0; time_s += robot.tick_s) wind_in(robot, measured_N, taut_N);
  EXPECT_EQ(taut_N[0], kTautLimit_N);
  measured_N.fill(robot.tension.plan_N);
  for (double time_s = 0.0; time_s < kTautLeak_s; time_s += robot.tick_s) wind_in(robot, measured_N, taut_N);
  EXPECT_NEAR(taut_N[0], kTautLimit_N * std::exp(-1.0), 1e-3 * kTautLimit_N);
}

}  // namespace
}  // namespace liana::cable
