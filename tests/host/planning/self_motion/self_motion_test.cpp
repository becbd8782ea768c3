#include "host/planning/self_motion/self_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "firmware_like/serial/kinematics.hpp"
#include "host/planning/self_motion/picture.hpp"

namespace liana::self_motion {
namespace {

constexpr std::size_t kJoints = 7;
constexpr double kStiffness_Nm_rad = 4264.0;

// lua/robots/macro.lua.
serial::RobotParams macro() {
  serial::RobotParams table;
  table.joint_count = kJoints;
  const double alpha_deg[kJoints] = {90, 90, 0, 0, 90, -90, 0};
  const double a_m[kJoints] = {0, 0, 4.30, 4.30, 0, 0, 0};
  const double d_m[kJoints] = {0.50, 0.40, 0.35, 0, 0.35, 0.40, 0.50};
  for (std::size_t i = 0; i < kJoints; ++i) {
    table.joint[i].dh = {alpha_deg[i] * kDegree, a_m[i], d_m[i], 0.0};
    table.joint[i].low_rad = -270.0 * kDegree;
    table.joint[i].high_rad = 270.0 * kDegree;
  }
  return table;
}

serial::JointVector radians(const std::array<double, kJoints>& joint_deg) {
  serial::JointVector joint_rad{};
  for (std::size_t i = 0; i < kJoints; ++i) joint_rad[i] = joint_deg[i] * kDegree;
  return joint_rad;
}

serial::JointVector all(double value) {
  serial::JointVector joints{};
  std::fill_n(joints.begin(), kJoints, value);
  return joints;
}

const serial::JointVector kPrepare = radians({13, -175, 126, -61, 16, 15, 136});

SelfMotion swept() { return self_motion(macro(), all(kStiffness_Nm_rad), kPrepare); }

// Where the tip goes under `force_N` in the base frame: every joint gives way to its torque, found by turning the joint
// a little, without any Jacobian.
Vec3 given_way_m(const serial::RobotParams& table, const serial::JointVector& joint_rad, const Vec3& force_N) {
  constexpr double kLittle_rad = 1e-6;
  Vec3 sum{};
  for (std::size_t i = 0; i < kJoints; ++i) {
    serial::JointVector more = joint_rad, less = joint_rad;
    more[i] += kLittle_rad;
    less[i] -= kLittle_rad;
    const Vec3 ahead = forward_kinematics(table, more).tip_in_base.position_m;
    const Vec3 behind = forward_kinematics(table, less).tip_in_base.position_m;
    const Vec3 lever = scale(subtract(ahead, behind), 0.5 / kLittle_rad);
    sum = add(sum, scale(lever, dot(lever, force_N) / kStiffness_Nm_rad));
  }
  return sum;
}

// req:B11
TEST(SelfMotion, GoesAroundOnceWithTheTipStillToANanometre) {
  const SelfMotion motion = swept();
  EXPECT_TRUE(motion.closed);
  EXPECT_NEAR(std::fabs(motion.way.back().arm_angle_rad) / kDegree, 360.0, 1.0);
  for (const Configuration& at : motion.way) {
    ASSERT_LE(at.tip_drift_m, kMaxTipDrift_m);
    ASSERT_LE(at.tip_turn_rad, 1e-9);
  }
}

// req:B11
TEST(SelfMotion, TheTipIsWhereTheKinematicsHasItInEveryConfiguration) {
  const SelfMotion motion = swept();
  const Pose start = forward_kinematics(macro(), kPrepare).tip_in_base;
  for (std::size_t i = 0; i < motion.way.size(); i += 50) {
    const Pose tip = forward_kinematics(macro(), motion.way[i].joint_rad).tip_in_base;
    ASSERT_LE(norm(subtract(tip.position_m, start.position_m)), kMaxTipDrift_m) << i;
  }
}

TEST(SelfMotion, NoStepIsLongerThanItHasToBe) {
  const SelfMotion motion = swept();
  for (std::size_t i = 1; i < motion.way.size(); ++i) {
    double square = 0.0;
    for (std::size_t j = 0; j < kJoints; ++j) {
      const double step = motion.way[i].joint_rad[j] - motion.way[i - 1].joint_rad[j];
      square += step * step;
    }
    ASSERT_NEAR(std::sqrt(square), kStep_rad, 0.1 * kStep_rad) << i;
  }
}

// req:B12
TEST(SelfMotion, TheTipGivesWayAsJointsThatAreSpringsLetIt) {
  const SelfMotion motion = swept();
  for (std::size_t i = 0; i < motion.way.size(); i += 97) {
    const serial::JointVector& joint_rad = motion.way[i].joint_rad;
    const Pose tip = forward_kinematics(macro(), joint_rad).tip_in_base;
    const Vec3 along_z = rotate(tip.quaternion, {0.0, 0.0, 1.0});
    const Vec3 moved_m = given_way_m(macro(), joint_rad, along_z);
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3 axis{};
      axis[k] = 1.0;
      ASSERT_NEAR(motion.way[i].deflection_m_per_N[k], dot(rotate(tip.quaternion, axis), moved_m), 1e-9) << i;
    }
  }
}

// req:B13
TEST(SelfMotion, TheDeflectionsOfTheLargeArmAreThoseOfTheSource) {
  // 0 to 20 mm under 1 N; the figures of an independent prototype: z 0.12 to 20.0, x 0.06 to 8.3, y 0.01 to 6.3
  const SelfMotion motion = swept();
  Vec3 most{};
  for (const Configuration& at : motion.way) {
    for (std::size_t k = 0; k < 3; ++k) most[k] = std::max(most[k], std::fabs(at.deflection_m_per_N[k]));
  }
  EXPECT_NEAR(most[2], 20.0e-3, 0.05e-3);
  EXPECT_NEAR(most[0], 8.3e-3, 0.2e-3);
  EXPECT_NEAR(most[1], 6.3e-3, 0.2e-3);
  EXPECT_NEAR(norm(motion.way[stiffest(motion)].deflection_m_per_N), 0.22e-3, 0.01e-3);
}

TEST(SelfMotion, AnArmTwiceAsStiffGivesWayHalfAsFar) {
  const SelfMotion one = swept(), two = self_motion(macro(), all(2.0 * kStiffness_Nm_rad), kPrepare);
  ASSERT_EQ(one.way.size(), two.way.size());
  for (std::size_t i = 0; i < one.way.size(); i += 100)
    EXPECT_NEAR(one.way[i].deflection_m_per_N[2], 2.0 * two.way[i].deflection_m_per_N[2], 1e-12);
}

TEST(SelfMotion, OfASingularArmIsSaidNotToClose) {
  const SelfMotion motion = self_motion(macro(), all(kStiffness_Nm_rad), all(0.0));
  EXPECT_FALSE(motion.closed);
  EXPECT_LT(motion.way.size(), kMaxSteps);
}

TEST(SelfMotion, SaysWhichConfigurationsAreOutOfRange) {
  serial::RobotParams narrow = macro();
  for (std::size_t i = 0; i < kJoints; ++i) {
    narrow.joint[i].low_rad = kPrepare[i] - 1.0 * kDegree;
    narrow.joint[i].high_rad = kPrepare[i] + 1.0 * kDegree;
  }
  const SelfMotion motion = self_motion(narrow, all(kStiffness_Nm_rad), kPrepare);
  EXPECT_TRUE(motion.way.front().within_ranges);
  EXPECT_FALSE(motion.way[motion.way.size() / 2].within_ranges);
}

}  // namespace
}  // namespace liana::self_motion
