// The torque that holds the arm is the slope of its potential, taken from the places of its modules.
#include "firmware_like/cable/arm/static_load.hpp"

#include <gtest/gtest.h>

#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using zhu2022::Random;

// Of weight and springs, from where every module lies.
double potential_J(const RobotParams& table, const ThetaVector& theta_rad) {
  const LinkPoints points = link_points(table, theta_rad);
  const Pose tip = tip_pose(table, arm_trig(table, theta_rad));
  double sum_J = 0.0;
  std::size_t link = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(table.segment_count); ++j) {
    const SegmentParams& segment = table.segment[j];
    for (std::int32_t i = 0; i < segment.modules; ++i, ++link) {
      const Vec3& from = points.point_in_base[link];
      const Vec3 at = add(from, scale(subtract(points.point_in_base[link + 1], from), segment.module_center));
      sum_J -= segment.module_mass_kg * dot(table.gravity_m_s2, at);
    }
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const double off = theta_rad[2 * j + axis] - segment.joint_rest_rad[axis];
      sum_J += 0.5 * segment.modules * segment.joint_stiffness_Nm_rad * off * off;
    }
  }
  const Vec3 tool = add(tip.position_m, rotate(tip.quaternion, table.tool.center_in_tip_m));
  return sum_J - table.tool.mass_kg * dot(table.gravity_m_s2, tool);
}

ThetaVector load_at(const RobotParams& table, const ThetaVector& theta_rad) {
  const ArmTrig trig = arm_trig(table, theta_rad);
  return static_load_Nm(table, theta_rad, trig, forward_kinematics(table, trig));
}

RobotParams random_arm(Random& random) {
  RobotParams table = zhu2022::table();
  table.gravity_m_s2 = random.vector(9.81);
  table.tool = {random.uniform(0.0, 2.0), random.vector(0.2)};
  table.segment_count = 1 + static_cast<std::int32_t>(random.uniform(0.0, 4.99));
  for (SegmentParams& segment : table.segment) {
    segment.modules = 1 + static_cast<std::int32_t>(random.uniform(0.0, 15.99));
    segment.module_length_m = random.uniform(0.01, 0.15);
    segment.module_mass_kg = random.uniform(0.01, 0.5);
    segment.module_center = random.uniform(0.2, 0.8);
    segment.joint_stiffness_Nm_rad = random.uniform(0.0, 3.0);
    segment.joint_rest_rad = {random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
  }
  return table;
}

TEST(StaticLoad, IsTheSlopeOfThePotentialForAnyArmAndDirectionOfGravity) {
  Random random(36);
  for (int n = 0; n < 200; ++n) {
    const RobotParams table = random_arm(random);
    ThetaVector theta_rad{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k)
      theta_rad[k] = random.uniform(-0.3, 0.3);
    const ThetaVector load_Nm = load_at(table, theta_rad);
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k) {
      constexpr double kStep_rad = 1e-5;
      ThetaVector more = theta_rad, less = theta_rad;
      more[k] += kStep_rad;
      less[k] -= kStep_rad;
      const double slope_Nm = (potential_J(table, more) - potential_J(table, less)) / (2.0 * kStep_rad);
      ASSERT_NEAR(load_Nm[k], slope_Nm, 1e-6 * (1.0 + std::fabs(slope_Nm))) << n << " " << k;
    }
    for (std::size_t k = static_cast<std::size_t>(table.theta_count()); k < kMaxTheta; ++k) EXPECT_EQ(load_Nm[k], 0.0);
  }
}

TEST(StaticLoad, OfAStraightLyingArmIsItsWeightTimesHalfItsLength) {
  RobotParams table = zhu2022::table();
  table.gravity_m_s2 = {0.0, 0.0, -9.81};
  const ThetaVector load_Nm = load_at(table, {});
  double kg = 0.0, kg_m = 0.0, length_m = 0.0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(table.segment_count); ++j) {
    const SegmentParams& segment = table.segment[j];
    const double own_kg = segment.modules * segment.module_mass_kg, own_m = segment.modules * segment.module_length_m;
    kg_m += own_kg * (length_m + 0.5 * own_m);
    kg += own_kg;
    length_m += own_m;
  }
  // The first segment's reduced angle turns all of its joints.
  EXPECT_GT(std::fabs(load_Nm[0]) + std::fabs(load_Nm[1]), 9.81 * kg * 0.3 * length_m);
  EXPECT_LT(std::fabs(load_Nm[0]) + std::fabs(load_Nm[1]), 9.81 * kg_m * table.segment[0].modules);
}

TEST(StaticLoad, OfToolAndPayloadTogetherIsThatOfTheirCommonCentre) {
  Random random(37);
  for (int n = 0; n < 100; ++n) {
    RobotParams table = random_arm(random);
    const TipLoad tool = table.tool, payload{random.uniform(0.0, 3.0), random.vector(0.3)};
    ThetaVector theta_rad{};
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k)
      theta_rad[k] = random.uniform(-0.3, 0.3);
    const auto load_with = [&](const TipLoad& tip) {
      table.tool = tip;
      return load_at(table, theta_rad);
    };
    const ThetaVector bare = load_with({}), one = load_with(tool), other = load_with(payload),
                      both = load_with(joined(tool, payload));
    for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k)
      ASSERT_NEAR(both[k] - bare[k], (one[k] - bare[k]) + (other[k] - bare[k]), 1e-9) << n << " " << k;
  }
  EXPECT_EQ(joined({}, {}).mass_kg, 0.0);
}

TEST(StaticLoad, AnArmWithoutWeightAndSpringsHasNone) {
  EXPECT_FALSE(has_static_load(zhu2022::table()));
  const ThetaVector load_Nm = load_at(zhu2022::table(), zhu2022::radians(zhu2022::kPrepare_deg));
  for (const double torque_Nm : load_Nm) EXPECT_EQ(torque_Nm, 0.0);
}

}  // namespace
}  // namespace liana::cable
