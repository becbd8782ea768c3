// What an arm with weight can carry, beside an independent sum of moments and the plan itself.
#include "host/planning/workspace/carry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "host/model/config/bench_buses.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::workspace {
namespace {

constexpr std::int32_t kFew = 300;

config::RobotConfig lab_1g(double ceiling_N = 200.0) {
  Json table = config::good_table("robot", "lab_1g");
  table["tension"]["ceiling_free_N"] = ceiling_N;
  return config::parse_robot(table.dump(), "r", "nominal", config::parse_buses(config::bench_buses(15), "b"));
}

Carried carried(const config::RobotConfig& robot, std::size_t mounting) {
  return what_it_carries(robot, mountings(robot.table)[mounting], kFew, 1);
}

TEST(Carry, AMountingIsTheTablesOrHasItsAmountOfGravityFromOneOfSixSides) {
  const config::RobotConfig robot = lab_1g();
  const std::vector<Mounting> all = mountings(robot.table);
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all.front().gravity_m_s2, robot.table.gravity_m_s2);
  Vec3 sum{};
  for (std::size_t i = 1; i < all.size(); ++i) {
    EXPECT_NEAR(norm(all[i].gravity_m_s2), norm(robot.table.gravity_m_s2), 1e-12);
    sum = add(sum, all[i].gravity_m_s2);
  }
  EXPECT_NEAR(norm(sum), 0.0, 1e-12) << "they cancel";
}

TEST(Carry, SharesAreOfAllPosesAndNoDrawnPoseIsHarderThanTheHardest) {
  const config::RobotConfig robot = lab_1g(90.0);
  for (std::size_t mounting = 0; mounting < 7; ++mounting) {
    const Carried one = carried(robot, mounting);
    EXPECT_NEAR(std::accumulate(one.share.begin(), one.share.end(), 0.0), 1.0, 1e-9);
    ASSERT_EQ(one.poses.size(), static_cast<std::size_t>(kFew));
    cable::RobotParams table = robot.table;
    table.gravity_m_s2 = one.mounting.gravity_m_s2;
    const PoseTension again = tension_at(table, one.worst_rad);
    EXPECT_EQ(again.max_N, one.worst.max_N);
    for (const CarriedPose& pose : one.poses) EXPECT_LE(pose.band, band_of(table.tension, one.worst));
  }
}

TEST(Carry, WithThePayloadAllNamedPosesKeepTheCeilingAndWithTwoGramsMoreOneDoesNot) {
  const config::RobotConfig robot = lab_1g();
  const Carried one = carried(robot, 0);
  ASSERT_TRUE(one.named.unloaded);
  ASSERT_GT(one.named.mass_kg, 0.0);
  EXPECT_LE(one.all.mass_kg, one.named.mass_kg) << "the named poses are among all";
  for (const double more_kg : {0.0, 0.002}) {
    cable::RobotParams table = robot.table;
    const double mass_kg = one.named.mass_kg + more_kg, own_kg = table.tool.mass_kg;
    table.tool.mass_kg += mass_kg;
    table.tool.center_in_tip_m = scale(robot.table.tool.center_in_tip_m, own_kg / table.tool.mass_kg);
    int beyond = 0;
    for (const auto& [name, angles_deg] : robot.named_poses_deg) {
      cable::ThetaVector theta_rad{};
      for (std::size_t k = 0; k < angles_deg.size(); ++k) theta_rad[k] = angles_deg[k] * config::kDeg;
      beyond += band_of(table.tension, tension_at(table, theta_rad)) != TensionBand::kFree;
    }
    EXPECT_EQ(beyond > 0, more_kg > 0.0);
  }
}

TEST(Carry, AHangingArmCarriesMoreInItsNamedPosesThanALyingOne) {
  const config::RobotConfig robot = lab_1g();
  EXPECT_GT(carried(robot, 1).named.mass_kg, carried(robot, 3).named.mass_kg);
}

TEST(Carry, AnArmThatIsTooHeavyUnloadedIsSaidToBe) {
  config::RobotConfig robot = lab_1g();
  for (auto& segment : robot.table.segment) segment.module_mass_kg *= 100.0;
  const Carried one = carried(robot, 3);
  EXPECT_FALSE(one.all.unloaded);
  EXPECT_EQ(one.all.mass_kg, 0.0);
  EXPECT_GT(one.all.tension_N, robot.table.tension.ceiling_free_N);
  EXPECT_GT(one.share.back(), 0.5);
}

TEST(Carry, APoseOverTheCeilingAndOneWithASlackCableAreToldWhatHelpsEach) {
  const auto says = [](const std::string& why, const char* field) { return why.find(field) != std::string::npos; };
  config::RobotConfig heavy = lab_1g(), slack = lab_1g();
  heavy.table.tension.ceiling_free_N = 31.0;
  for (auto& segment : slack.table.segment) segment.face_offset_m = 1e-5;
  int over = 0, below = 0;
  for (const auto& [name, angles_deg] : heavy.named_poses_deg) {
    const double ceiling_N = heavy.table.tension.ceiling_free_N, floor_N = slack.table.tension.floor_motor_N;
    const PoseTension of_heavy = tension_at(heavy, name), of_slack = tension_at(slack, name);
    if (of_heavy.max_N > ceiling_N && of_heavy.min_N >= floor_N) {
      ++over;
      EXPECT_TRUE(says(refusal_of_pose(heavy, name), "tension.ceiling_free_N"));
    }
    if (of_slack.min_N < floor_N) {
      ++below;
      EXPECT_TRUE(says(refusal_of_pose(slack, name), "cables.face_offset_m"));
      EXPECT_FALSE(says(refusal_of_pose(slack, name), "tension.ceiling_free_N"));
    }
  }
  EXPECT_GT(over, 0);
  EXPECT_GT(below, 0);
}

// A drive of a base holds up to the hard limit, as fault 5002 judges it: the slide its weight along x, the roll what
// its small wheel makes of the arm's.
TEST(Carry, ABaseWhoseDriveHoldsMoreThanTheHardLimitIsRefusedWithItsAxis) {
  const auto feeder = [] {
    return config::parse_robot(config::good_table("robot", "feeder").dump(), "r", "nominal",
                               config::parse_buses(config::bench_buses(14), "b"));
  };
  const config::RobotConfig fits = feeder();
  EXPECT_EQ(refusal_of_pose(fits, "zero"), "");
  config::RobotConfig slide = feeder();
  slide.table.gravity_m_s2 = {9.80665, 0.0, 0.0};
  slide.table.segment[0].module_mass_kg = 1.01 * slide.table.tension.hard_limit_N / 9.80665;
  const Carried carries = what_it_carries(slide, mountings(slide.table)[0], 50, 1);
  EXPECT_EQ(carries.worst.max_cable, 0u);
  EXPECT_FALSE(carries.all.unloaded);
  EXPECT_NEAR(carries.share.back(), 1.0, 1e-9);
  EXPECT_NE(refusal_of_pose(slide, "zero").find("slide"), std::string::npos);
  slide.table.segment[0].module_mass_kg *= 0.5;
  const Carried lighter = what_it_carries(slide, mountings(slide.table)[0], 50, 1);
  EXPECT_GT(lighter.worst.max_cable, 1u);
  config::RobotConfig roll = feeder();
  roll.table.segment[0].roll_radius_m = 1e-4;
  cable::ThetaVector aside_rad{};
  for (std::size_t k = 2; k < static_cast<std::size_t>(roll.table.theta_count()); k += 2) aside_rad[k] = 0.1;
  EXPECT_EQ(tension_at(roll.table, aside_rad).max_cable, 1u);
}

TEST(Carry, ThePictureHasAPanelOfEveryMounting) {
  const config::RobotConfig robot = lab_1g();
  std::vector<Carried> all;
  for (const Mounting& mounting : mountings(robot.table)) all.push_back(what_it_carries(robot, mounting, 50, 1));
  const std::string svg = carry_picture(robot, all);
  for (const Carried& one : all) EXPECT_NE(svg.find(">" + one.mounting.name + "<"), std::string::npos);
}

}  // namespace
}  // namespace liana::workspace
