// Periods of arms whose joints are springs: by hand, and of the pair of arms that the payload's mission flies.
#include "host/planning/self_motion/swings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "firmware_like/serial/kinematics.hpp"

namespace liana::self_motion {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

// Joints about parallel axes, a link of `length_m` behind each.
serial::RobotParams in_a_plane(std::int32_t joints, double length_m) {
  serial::RobotParams table;
  table.joint_count = joints;
  for (std::size_t i = 0; i < table.joints(); ++i) table.joint[i].dh.a_m = length_m;
  return table;
}

TEST(Swings, AMassOnOneSpringSwingsAsByHand) {
  const serial::RobotParams table = in_a_plane(1, 2.0);
  const serial::JointVector joint_rad{0.7}, stiffness_Nm_rad{4264.0};
  const serial::LinkMass load{300.0, {0.5, 0.0, 0.0}, {1.0, 1.0, 40.0, 0.0, 0.0, 0.0}};
  const SpringyArm arm{table, {}, joint_rad, stiffness_Nm_rad};
  const std::vector<double> periods_s = swing_periods_s({&arm, 1}, load);
  ASSERT_EQ(periods_s.size(), 1u);
  EXPECT_NEAR(periods_s[0], kTurn * std::sqrt((300.0 * 2.5 * 2.5 + 40.0) / 4264.0), 1e-9);
}

// Two equal masses on equal links, straight: M = m l^2 [[5, 2], [2, 1]] with springs of 1, of which the eigenvalues are
// 3 +- 2 sqrt(2).
TEST(Swings, TwoArmsOneOnTheOtherSwingTogether) {
  const serial::RobotParams table = in_a_plane(1, 1.0);
  serial::MassTable masses;
  masses.link[0].mass_kg = 1.0;
  const serial::JointVector straight{}, stiffness_Nm_rad{1.0};
  const SpringyArm chain[] = {{table, masses, straight, stiffness_Nm_rad}, {table, masses, straight, stiffness_Nm_rad}};
  const std::vector<double> periods_s = swing_periods_s(chain, {});
  ASSERT_EQ(periods_s.size(), 2u);
  EXPECT_NEAR(periods_s[0], kTurn * (std::sqrt(2.0) + 1.0), 1e-9);
  EXPECT_NEAR(periods_s[1], kTurn * (std::sqrt(2.0) - 1.0), 1e-9);
  const serial::RobotParams both = in_a_plane(2, 1.0);
  masses.link[1] = masses.link[0];
  const serial::JointVector stiffness_of_both{1.0, 1.0};
  const SpringyArm one{both, masses, straight, stiffness_of_both};
  EXPECT_NEAR(swing_periods_s({&one, 1}, {})[0], periods_s[0], 1e-12) << "where one arm ends makes no difference";
}

TEST(Swings, WhatHasNoInertiaDoesNotSwing) {
  const serial::RobotParams table = in_a_plane(2, 1.0);
  serial::MassTable masses;
  masses.link[0].mass_kg = 1.0;
  const serial::JointVector straight{}, stiffness_Nm_rad{1.0, 1.0};
  const SpringyArm arm{table, masses, straight, stiffness_Nm_rad};
  EXPECT_NEAR(swing_periods_s({&arm, 1}, {})[1], 0.0, 1e-7);
}

}  // namespace
}  // namespace liana::self_motion
