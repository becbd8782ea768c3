// An arm on a base that feeds is the same arm, moved and turned: whatever it computes is compared with that of the arm
// on a fixed base.
#include <gtest/gtest.h>

#include "firmware_like/cable/arm/static_load.hpp"
#include "firmware_like/cable/motion/servo_ik.hpp"
#include "tests/firmware_like/ideal_drives.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::largest_difference;
using zhu2022::Random;

constexpr double kSlide_m_rad = 0.3, kRoll_m = 0.05;

// The same arm on such a base, which is segment 1.
RobotParams fed(const RobotParams& fixed) {
  RobotParams table = fixed;
  table.segment_count = fixed.segment_count + 1;
  table.segment[0] = SegmentParams{};
  table.segment[0].cables = 2;
  table.segment[0].theta_limit_rad = 90.0 * kDegree;
  table.segment[0].slide_m_rad = kSlide_m_rad;
  table.segment[0].roll_radius_m = kRoll_m;
  for (std::size_t m = 0; m < static_cast<std::size_t>(fixed.segment_count); ++m)
    table.segment[m + 1] = fixed.segment[m];
  return table;
}

// Slide and roll, then the arm's angles; and those without the base.
ThetaVector drawn(Random& random, const RobotParams& table) {
  ThetaVector theta = random.theta(table, 15.0);
  theta[0] = random.uniform(-1.5, 1.5);
  theta[1] = random.uniform(-1.5, 1.5);
  return theta;
}
template <class Vector>
Vector without_base(const Vector& all) {
  Vector out{};
  for (std::size_t k = 0; k + 2 < all.size(); ++k) out[k] = all[k + 2];
  return out;
}
Pose base_at(const ThetaVector& theta_rad) {
  return {{kSlide_m_rad * theta_rad[0], 0.0, 0.0}, quaternion_of({theta_rad[1], 0.0, 0.0})};
}

class FeedingBase : public testing::TestWithParam<RobotParams> {
 protected:
  RobotParams fixed_ = GetParam();
  RobotParams table_ = fed(fixed_);
  Random random_{3607};
};

// req:A1
TEST_P(FeedingBase, CarriesTheArmAlongAndTurnsIt) {
  for (int n = 0; n < 100; ++n) {
    const ThetaVector theta_rad = drawn(random_, table_);
    const LinkPoints alone = link_points(fixed_, without_base(theta_rad)), moved = link_points(table_, theta_rad);
    ASSERT_EQ(moved.count, alone.count);
    const Pose base = base_at(theta_rad);
    for (std::size_t i = 0; i < static_cast<std::size_t>(alone.count); ++i) {
      const Vec3 expected = compose(base, {alone.point_in_base[i], {}}).position_m;
      ASSERT_LT(norm(subtract(moved.point_in_base[i], expected)), 1e-12) << i;
    }
    const Pose tip = forward_kinematics(table_, theta_rad).tip_in_base;
    const Pose expected = compose(base, forward_kinematics(fixed_, without_base(theta_rad)).tip_in_base);
    EXPECT_LT(norm(subtract(tip.position_m, expected.position_m)), 1e-12);
    EXPECT_LT(largest_difference(tip.quaternion, expected.quaternion), 1e-12);
    const Pose brief = tip_pose(table_, arm_trig(table_, theta_rad));
    EXPECT_EQ(brief.position_m, tip.position_m);
    EXPECT_EQ(brief.quaternion, tip.quaternion);
  }
}

// req:A2
TEST_P(FeedingBase, ColumnsAreTheTipsVelocities) {
  constexpr double kStep = 1e-6;
  for (int n = 0; n < 30; ++n) {
    const ThetaVector theta_rad = drawn(random_, table_);
    const ArmKinematics arm = forward_kinematics(table_, theta_rad);
    for (std::size_t k = 0; k < static_cast<std::size_t>(table_.theta_count()); ++k) {
      ThetaVector after = theta_rad, before = theta_rad;
      after[k] += kStep, before[k] -= kStep;
      const Pose a = forward_kinematics(table_, after).tip_in_base, b = forward_kinematics(table_, before).tip_in_base;
      const Vec3 linear = scale(subtract(a.position_m, b.position_m), 0.5 / kStep);
      const Vec3 angular = scale(rotation_vector(multiply(a.quaternion, conjugate(b.quaternion))), 0.5 / kStep);
      ASSERT_LT(norm(subtract(arm.tip_jacobian.linear[k], linear)), 1e-8) << k;
      ASSERT_LT(norm(subtract(arm.tip_jacobian.angular[k], angular)), 1e-8) << k;
    }
  }
}

// req:A3
TEST_P(FeedingBase, ChangesNoCableAndItsTwoDrivesTellWhereItStands) {
  const CableLayout layout = cable_layout(table_), alone = cable_layout(fixed_);
  ASSERT_EQ(layout.cable_count, alone.cable_count + 2);
  for (int n = 0; n < 30; ++n) {
    const ThetaVector theta_rad = drawn(random_, table_);
    const CableGeometry here = cable_geometry(table_, layout, arm_trig(table_, theta_rad));
    const CableGeometry fixed = cable_geometry(fixed_, alone, arm_trig(fixed_, without_base(theta_rad)));
    EXPECT_LT(largest_difference(without_base(here.length_m), fixed.length_m), 1e-15);
    EXPECT_NEAR(here.length_m[0], kSlide_m_rad * (theta_rad[0] + 90.0 * kDegree), 1e-15);
    EXPECT_NEAR(here.length_m[1], kRoll_m * (theta_rad[1] + 90.0 * kDegree), 1e-15);
    // Lengths say how far the whole arm has been moved since.
    ThetaVector turned = theta_rad;
    for (std::size_t k = 0; k < static_cast<std::size_t>(table_.theta_count()); ++k)
      turned[k] += random_.uniform(-1e-4, 1e-4);
    const CableGeometry there = cable_geometry(table_, layout, arm_trig(table_, turned));
    CableSolver solver;
    update_cable_solver(table_, here, solver);
    CableVector change_m{};
    for (std::size_t c = 0; c < change_m.size(); ++c) change_m[c] = there.length_m[c] - here.length_m[c];
    const ThetaVector found = solve_cables(table_, here, solver, change_m).theta_rad;
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(found[k], turned[k] - theta_rad[k], 1e-12);
    for (std::size_t k = 2; k < static_cast<std::size_t>(table_.theta_count()); ++k)
      EXPECT_NEAR(found[k], turned[k] - theta_rad[k], 1e-6);
  }
}

TEST_P(FeedingBase, ItsSlideTakesTheWholeArmsWeightAndItsRollTurnsGravityForTheArm) {
  table_.gravity_m_s2 = {3.0, -4.0, -7.0};
  for (int n = 0; n < 30; ++n) {
    const ThetaVector theta_rad = drawn(random_, table_);
    fixed_.gravity_m_s2 = rotate(conjugate(base_at(theta_rad).quaternion), table_.gravity_m_s2);
    const ArmTrig trig = arm_trig(table_, theta_rad), alone = arm_trig(fixed_, without_base(theta_rad));
    const ThetaVector load_Nm = static_load_Nm(table_, theta_rad, trig, forward_kinematics(table_, trig));
    const ThetaVector expected_Nm =
        static_load_Nm(fixed_, without_base(theta_rad), alone, forward_kinematics(fixed_, alone));
    EXPECT_LT(largest_difference(without_base(load_Nm), expected_Nm), 1e-11);
    double mass_kg = 0.0;
    for (std::size_t m = 0; m < static_cast<std::size_t>(fixed_.segment_count); ++m)
      mass_kg += fixed_.segment[m].modules * fixed_.segment[m].module_mass_kg;
    EXPECT_NEAR(load_Nm[0], -3.0 * mass_kg * kSlide_m_rad, 1e-11);
    const CableVector motor_N = plan_at_rest(table_, cable_layout(table_), theta_rad).motor_N;
    const CableVector alone_N = plan_at_rest(fixed_, cable_layout(fixed_), without_base(theta_rad)).motor_N;
    EXPECT_LT(largest_difference(without_base(motor_N), alone_N), 1e-8);
    EXPECT_EQ(motor_N[0], 0.0);
    EXPECT_EQ(motor_N[1], 0.0);
  }
}

TEST_P(FeedingBase, IkReachesWhatTheSlideBringsWithinReach) {
  for (int n = 0; n < 20; ++n) {
    const ThetaVector goal_rad = drawn(random_, table_);
    ThetaVector theta_rad = goal_rad;
    theta_rad[0] -= random_.uniform(-0.3, 0.3);
    for (std::size_t k = 1; k < static_cast<std::size_t>(table_.theta_count()); ++k)
      theta_rad[k] += random_.uniform(-2.0, 2.0) * kDegree;
    IkGoal goal;
    goal.tip_in_base = forward_kinematics(table_, goal_rad).tip_in_base;
    IkResult result;
    for (int step = 0; step < 200; ++step) result = ik_step(table_, goal, 1e-6, theta_rad);
    EXPECT_LT(result.position_error_m, 1e-4) << n;
    EXPECT_LT(result.attitude_error_rad, 1e-3) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(Of, FeedingBase, testing::Values(zhu2022::table(), zhu2022::uneven_table()));

// A controller on ideal drives.
struct FedRig : Rig {
  explicit FedRig(const RobotParams& fixed, const ThetaVector& theta_rad) : Rig(fed(fixed), theta_rad) {}
};

RobotParams with_weight() {
  RobotParams table = zhu2022::table();
  table.gravity_m_s2 = {0.0, 0.0, -0.2};
  table.limits.theta_rate_rad_s = 5.0 * kDegree;
  table.limits.tip_speed_m_s = 0.03;
  return table;
}

TEST(FedArm, SlidesAndRollsToWhereItIsTold) {
  ThetaVector theta_rad{};
  theta_rad[0] = -1.0;
  FedRig rig(with_weight(), theta_rad);
  ASSERT_NO_FATAL_FAILURE(rig.enable());
  ThetaVector goal_rad{};
  goal_rad[0] = -0.8, goal_rad[1] = 0.2, goal_rad[2] = 0.05;
  rig.tick(Request::kNone, rig.release(rig.joints(goal_rad)));
  rig.run(6000);
  EXPECT_EQ(rig.out.faults.count, 0);
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_LT(largest_difference(rig.out.theta_measured_rad, goal_rad), 1e-3);
  EXPECT_NEAR(rig.out.tension_measured_N[0], 0.0, 0.0);
  EXPECT_GT(rig.out.tension_plan_N[2], rig.robot.tension.floor_motor_N);
}

TEST(FedArm, ItsTipGoesForwardByTheSlideAlone) {
  FedRig rig(with_weight(), ThetaVector{});
  ASSERT_NO_FATAL_FAILURE(rig.enable());
  const Pose before = rig.out.tip_command;
  rig.tick(Request::kNone, rig.release(rig.tip_by({0.02, 0.0, 0.0})));
  rig.run(3000);
  EXPECT_EQ(rig.out.faults.count, 0);
  EXPECT_NEAR(rig.out.tip_command.position_m[0] - before.position_m[0], 0.02, 1e-4);
  EXPECT_NEAR(kSlide_m_rad * rig.out.theta_command_rad[0], 0.02, 1e-3);
}

// Slide and roll have no cable that could be slack: whatever torque their drives report, as long as friction may be it.
TEST(FedArm, TorqueOfItsTwoDrivesIsNoTension) {
  FedRig rig(zhu2022::table(), ThetaVector{});
  ASSERT_NO_FATAL_FAILURE(rig.enable());
  for (const std::int16_t permille : {std::int16_t{-50}, std::int16_t{0}, std::int16_t{50}}) {
    for (int i = 0; i < 200; ++i) {
      Inputs inputs = rig.drives.inputs(rig.now++);
      inputs.drive[0].torque_permille = inputs.drive[1].torque_permille = permille;
      rig.out = rig.controller.tick(inputs);
      rig.drives.act(rig.out);
    }
    EXPECT_EQ(rig.out.faults.count, 0) << permille;
  }
}

}  // namespace
}  // namespace liana::cable
