// Joint angles back from motor lengths and tensions.
#include "firmware_like/cable/arm/estimator.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable/arm/tension.hpp"
#include "tests/firmware_like/pose_of_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

// What the motors of an arm at rest would report.
struct Measured {
  CableVector payout_m{};
  CableVector tension_N{};
  TensionRatio ratio{};
};

Measured measured_at(const RobotParams& robot, const ThetaVector& theta, const SlipState& slip) {
  const CableLayout layout = cable_layout(robot);
  const ArmTrig trig = arm_trig(robot, theta);
  const CableGeometry geometry = cable_geometry(robot, layout, trig);
  const TensionRatio ratio = tension_ratio(robot, layout, trig, slip);
  const CableVector motor_N = plan_tension(robot, geometry, ratio, SegmentVector{}).motor_N;
  return {payout_for(robot, layout, geometry.part_m, ratio, motor_N), motor_N, ratio};
}

CableModel model_at(const RobotParams& robot, const CableLayout& layout, const ThetaVector& theta) {
  CableModel model;
  model.theta_rad = theta;
  update_cable_geometry(robot, layout, arm_trig(robot, theta), model.geometry);
  update_cable_solver(robot, model.geometry, model.solver);
  return model;
}

// As for an arm that is not commanded: the model follows the estimate.
void run(const RobotParams& robot, const Measured& measured, std::int32_t ticks, EstimatorState& state) {
  const CableLayout layout = cable_layout(robot);
  for (std::int32_t i = 0; i < ticks; ++i) {
    estimate(robot, layout, model_at(robot, layout, state.theta_rad), measured.ratio, measured.payout_m,
             measured.tension_N, state);
  }
}

// req:A11
TEST(Estimator, FindsAnyPoseFromZeroWithinThirtyTicks) {
  for (const RobotParams& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    Random random(1);
    for (std::int32_t i = 0; i < 300; ++i) {
      const ThetaVector theta = random.theta(robot, 20.0);
      const SlipState slip = random_slip(random);
      EstimatorState state;
      run(robot, measured_at(robot, theta, slip), 30, state);
      ASSERT_LE(zhu2022::largest_difference(state.theta_rad, theta), 1e-10) << i;
      ASSERT_LE(state.largest_step_rad, 1e-10);
      ASSERT_LE(zhu2022::length(state.residual_m), 1e-10);
    }
  }
}

TEST(Estimator, TakesTheElongationOutOfTheLengths) {
  const RobotParams robot = zhu2022::table(0.0);
  const ThetaVector theta = zhu2022::radians(zhu2022::kPanelEdge_deg);
  Measured measured = measured_at(robot, theta, SlipState{});
  EstimatorState right, wrong;
  run(robot, measured, 30, right);
  measured.tension_N = CableVector{};  // as if the cables did not stretch
  run(robot, measured, 30, wrong);
  EXPECT_LE(zhu2022::largest_difference(right.theta_rad, theta), 1e-10);
  EXPECT_GE(zhu2022::largest_difference(wrong.theta_rad, theta), 0.01 * kDegree);
}

TEST(Estimator, FollowsAMovingArmWithAFractionOfATicksMotion) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector step = Random(2).theta(robot, 2.0 * robot.tick_s);  // 2 deg/s
  ThetaVector theta{};
  EstimatorState state;
  for (std::int32_t i = 0; i < 500; ++i) {
    theta = zhu2022::plus(theta, step);
    run(robot, measured_at(robot, theta, SlipState{}), 1, state);
  }
  EXPECT_LE(zhu2022::largest_difference(state.theta_rad, theta), 0.01 * kDegree);
}

TEST(Estimator, AWrongZeroShowsInTheResidual) {
  const RobotParams robot = zhu2022::table();
  Measured measured = measured_at(robot, zhu2022::radians(zhu2022::kPrepare_deg), SlipState{});
  measured.payout_m[7] += 0.010;
  EstimatorState state;
  run(robot, measured, 100, state);
  EXPECT_GE(std::fabs(state.residual_m[7]), 1.5e-3);
}

TEST(Estimator, TakesTheFirstTensionAsItIsAndFiltersTheOthers) {
  const RobotParams robot = zhu2022::table();
  Measured measured = measured_at(robot, ThetaVector{}, SlipState{});
  EstimatorState state;
  run(robot, measured, 1, state);
  EXPECT_EQ(state.tension_N, measured.tension_N);
  const double before_N = measured.tension_N[0];
  measured.tension_N[0] += 6.0;
  run(robot, measured, 1, state);
  EXPECT_NEAR(state.tension_N[0], before_N + 6.0 * 0.004 / 0.024, 1e-12);
}

// A wild measurement moves the estimate by a bounded step, and it comes back.
TEST(Estimator, OneWildMeasurementIsBoundedAndForgotten) {
  const RobotParams robot = zhu2022::table();
  const ThetaVector theta = zhu2022::radians(zhu2022::kPressRod_deg);
  const Measured measured = measured_at(robot, theta, SlipState{});
  EstimatorState state;
  run(robot, measured, 30, state);
  Measured wild = measured;
  wild.payout_m[0] += 5.0;
  const ThetaVector before = state.theta_rad;
  run(robot, wild, 1, state);
  EXPECT_LE(zhu2022::largest_difference(state.theta_rad, before), 0.1 + 1e-15);
  EXPECT_EQ(state.largest_step_rad, 0.1);
  run(robot, measured, 60, state);
  wild.payout_m[0] -= 10.0;
  run(robot, wild, 1, state);
  EXPECT_EQ(state.largest_step_rad, 0.1) << "the other way";
  run(robot, measured, 60, state);
  EXPECT_LE(zhu2022::largest_difference(state.theta_rad, theta), 1e-9);
}

// The motors' angles serve as the place of linearisation: a deflected arm is found to second order.
TEST(Estimator, FindsADeflectedArmToHalfTheSquareOfItsDeflection) {
  const RobotParams robot = zhu2022::table();
  const CableLayout layout = cable_layout(robot);
  Random random(4);
  for (const double deflection_deg : {0.1, 0.3, 1.0, 3.0}) {
    for (std::int32_t i = 0; i < 50; ++i) {
      const ThetaVector motors = random.theta(robot, 15.0),
                        theta = zhu2022::plus(motors, random.theta(robot, deflection_deg));
      const Measured measured = measured_at(robot, theta, SlipState{});
      const CableModel model = model_at(robot, layout, motors);
      EstimatorState state;
      state.theta_rad = motors;
      for (std::int32_t k = 0; k < 3; ++k) {
        estimate(robot, layout, model, measured.ratio, measured.payout_m, measured.tension_N, state);
      }
      const double deflection_rad = deflection_deg * kDegree;
      ASSERT_LE(zhu2022::largest_difference(state.theta_rad, theta), deflection_rad * deflection_rad) << deflection_deg;
    }
  }
}

// req:A2 req:A11
TEST(CableSolver, UndoesTheCableJacobian) {
  const RobotParams robot = zhu2022::table();
  const CableLayout layout = cable_layout(robot);
  Random random(3);
  CableSolver solver;
  for (std::int32_t i = 0; i < 100; ++i) {
    const CableGeometry geometry = cable_geometry(robot, layout, arm_trig(robot, random.theta(robot, 20.0)));
    update_cable_solver(robot, geometry, solver);
    const ThetaVector turn = random.theta(robot, 1.0);
    CableVector change{};
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) change[c] += geometry.jacobian_m_rad[c][k] * turn[k];
    }
    ASSERT_LE(zhu2022::largest_difference(solve_cables(robot, geometry, solver, change).theta_rad, turn), 1e-13);
  }
}

TEST(CableSolver, GivesZeroWhenNoCableTurnsAnAngle) {
  RobotParams robot = zhu2022::table();
  for (SegmentParams& segment : robot.segment) segment.hole_radius_m = 0.0;
  const CableLayout layout = cable_layout(robot);
  CableSolver solver;
  const CableGeometry geometry = cable_geometry(robot, layout, arm_trig(robot, ThetaVector{}));
  update_cable_solver(robot, geometry, solver);
  CableVector change{};
  change.fill(0.01);
  EXPECT_EQ(solve_cables(robot, geometry, solver, change).theta_rad, ThetaVector{});
}

}  // namespace
}  // namespace liana::cable
