#include "host/planning/workspace/arm.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/micro_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::workspace {
namespace {

namespace micro = serial::micro;
namespace zhu2022 = cable::zhu2022;

AngleRange degrees_range(double low_deg, double high_deg) { return {low_deg * kDegree, high_deg * kDegree}; }

TEST(AngleRange, HoldsATurnFromThreeHundredAndSixtyDegreesOn) {
  EXPECT_TRUE(holds_a_turn(degrees_range(-180.0, 180.0)));
  EXPECT_TRUE(holds_a_turn(degrees_range(-270.0, 270.0)));
  EXPECT_TRUE(holds_a_turn(degrees_range(-350.0, 10.0)));
  EXPECT_FALSE(holds_a_turn(degrees_range(-179.9, 180.0)));
  EXPECT_FALSE(holds_a_turn(degrees_range(0.0, 0.0)));
}

TEST(AngleRange, IsDrawnFromOverOneTurnAtMost) {
  EXPECT_DOUBLE_EQ(drawn_half_rad(degrees_range(-270.0, 270.0)), kPi);
  EXPECT_DOUBLE_EQ(drawn_half_rad(degrees_range(-40.0, 60.0)), 50.0 * kDegree);
}

TEST(AngleRange, EndsForAnAngleOrLetsItGoOnATurnBefore) {
  EXPECT_DOUBLE_EQ(into_range(degrees_range(-40.0, 60.0), 61.0 * kDegree), 60.0 * kDegree);
  EXPECT_DOUBLE_EQ(into_range(degrees_range(-40.0, 60.0), -41.0 * kDegree), -40.0 * kDegree);
  EXPECT_EQ(into_range(degrees_range(-270.0, 270.0), 260.0 * kDegree), 260.0 * kDegree);  // inside: as it is
  EXPECT_NEAR(into_range(degrees_range(-270.0, 270.0), 271.0 * kDegree), -89.0 * kDegree, 1e-12);
  EXPECT_NEAR(into_range(degrees_range(0.0, 400.0), -10.0 * kDegree), 350.0 * kDegree, 1e-12);
}

// Every column against the difference of two poses, at every point of both kinds of arm.
void expect_columns_are_derivatives(const ReachArm& arm, const AngleVector& at_rad) {
  constexpr double kStep_rad = 1e-6;
  for (std::int32_t node = 0; node <= arm.node_count; ++node) {
    const PointMotion motion = arm.motion(node, at_rad);
    for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i) {
      AngleVector low = at_rad, high = at_rad;
      low[i] -= kStep_rad;
      high[i] += kStep_rad;
      const Vec3 moved_m = subtract(arm.motion(node, high).point_in_base_m, arm.motion(node, low).point_in_base_m);
      EXPECT_LT(norm(subtract(scale(moved_m, 0.5 / kStep_rad), motion.column[i])), 1e-8) << node << " " << i;
      if (i >= static_cast<std::size_t>(arm.angles_to[static_cast<std::size_t>(node)])) {
        EXPECT_EQ(motion.column[i], (Vec3{}));
      }
    }
  }
}

TEST(ReachArmOfEitherKind, HasColumnsThatAreTheDerivativesOfItsPoints) {
  micro::Random random(5);
  zhu2022::Random cable_random(5);
  for (int trial = 0; trial < 20; ++trial) {
    const serial::RobotParams six = micro::six_joint_table();
    expect_columns_are_derivatives(arm_of(six), angles_of(micro::random_joints(six, random)));
    expect_columns_are_derivatives(arm_of(micro::table()), angles_of(micro::random_joints(micro::table(), random)));
    expect_columns_are_derivatives(arm_of(zhu2022::table()), cable_random.theta(zhu2022::table(), 20.0));
  }
}

TEST(ReachArmOfEitherKind, IsDrawnFromItsBaseToItsTip) {
  micro::Random random(6);
  const serial::RobotParams table = micro::six_joint_table();
  for (const ReachArm& arm : {arm_of(table), arm_of(zhu2022::table())}) {
    AngleVector angle_rad{};
    for (std::size_t i = 0; i < 6; ++i) angle_rad[i] = random.uniform(-0.3, 0.3);
    const std::vector<Vec3> line = arm.centre_line(angle_rad);
    EXPECT_EQ(line.front(), (Vec3{}));
    EXPECT_LT(norm(subtract(line.back(), arm.motion(arm.node_count, angle_rad).point_in_base_m)), 1e-12);
  }
}

}  // namespace
}  // namespace liana::workspace
