// Goals of the tip that a mission names: what no pose of an arm reaches is refused before anything starts, what one
// reaches never is.
#include <gtest/gtest.h>

#include <random>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/math/trig.hpp"
#include "firmware_like/serial/kinematics.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/apps/launcher/validate_goals.hpp"
#include "tests/message.hpp"

namespace liana::launcher {
namespace {

Json tip(const Pose& pose) {
  Json numbers = Json::array();
  for (const double each : pose.position_m) numbers.push_back(each);
  for (const double each : pose.quaternion) numbers.push_back(each);
  return numbers;
}

// A described mission whose steps go to these goals; the second one stands at line 7 of its script.
Json mission_to(const std::vector<Json>& goals) {
  Json steps = Json::array();
  for (std::size_t i = 0; i < goals.size(); ++i)
    steps.push_back({{"name", "s" + std::to_string(i + 1)},
                     {"at", "m.lua:3: "},
                     {"goal_at", "m.lua:" + std::to_string(6 + i) + ": "},
                     {"goal_tip", goals[i]},
                     {"goal_hold", Json::array()}});
  return {{"name", "m"}, {"steps", steps}};
}

std::vector<double> zeros(const config::RobotConfig& robot) {
  return std::vector<double>(static_cast<std::size_t>(robot.table.theta_count()), 0.0);
}

std::string said_of(const config::RobotConfig& robot, const std::vector<Json>& goals) {
  try {
    const std::vector<std::string> notes = look_at_tip_goals(mission_to(goals), robot, zeros(robot));
    return notes.empty() ? "found" : "note: " + notes.front();
  } catch (const BadInput& problem) {
    return problem.what();
  }
}

// The lab's arm of 18 modules, each of which bends by less.
config::RobotConfig lab_that_bends(double limit_deg) {
  config::RobotConfig lab = robot_for_kinematics("three_segment_lab");
  for (cable::SegmentParams& segment : lab.table.segment) segment.theta_limit_rad = limit_deg * kDegree;
  return lab;
}

TEST(MissionGoals, WhatNoPoseReachesIsRefusedByLineStepAndGoal) {
  const config::RobotConfig lab = lab_that_bends(10.0);
  struct Case {
    std::vector<double> goal;
    Facts facts;
  };
  for (const Case& each : std::vector<Case>{{{0.3, 0.1, 0, 1, 0, 0, 0}, {"0.316 m", "bent"}},
                                            {{-1.3, 0, 0, 1, 0, 0, 0}, {"x", "-1.3 m"}}}) {
    const std::string said = said_of(lab, {Json(std::vector<double>{1.44, 0, 0, 1, 0, 0, 0}), Json(each.goal)});
    EXPECT_TRUE(names(said, {"m.lua:7", "mission m", "step 2", "s2", "move_cp", "goal", "three_segment_lab"}));
    EXPECT_TRUE(names(said, each.facts));
  }
}

TEST(MissionGoals, AnAttitudeThatAllJointsTogetherDoNotTurnToIsRefused) {
  const config::RobotConfig lab = lab_that_bends(5.0);
  const std::string said = said_of(lab, {Json(std::vector<double>{1.3, 0.1, 0, 0, 0, 1, 0})});
  EXPECT_TRUE(names(said, {"180.0 deg", "127.3 deg"}));
}

// The search cannot find this attitude there, and no bound excludes it.
TEST(MissionGoals, WhatIsNeitherFoundNorExcludedIsANoteWithTheNearest) {
  const config::RobotConfig lab = robot_for_kinematics("three_segment_lab");
  const std::string said = said_of(lab, {Json(std::vector<double>{1.44, 0, 0, 0.8, 0.6, 0, 0})});
  EXPECT_TRUE(names(said, {"note", "m.lua:6", "step 1", "s1", "move_cp", "1.44", "not found"}));
  EXPECT_NE(said.find("deg off"), std::string::npos) << said;
}

// Where the arm stands at limits that the table allows, drawn by seed, on tables of other stiffness, too.
TEST(MissionGoals, NoPoseOfAnyArmIsRefused) {
  std::mt19937_64 random(20261125);
  std::uniform_real_distribution<double> share(-1.0, 1.0), limit_deg(0.5, 25.0);
  int looked_at = 0;
  for (const char* name : {"zhu2022", "three_segment_lab"}) {
    config::RobotConfig robot = robot_for_kinematics(name);
    for (int i = 0; i < 60; ++i) {
      for (cable::SegmentParams& segment : robot.table.segment) segment.theta_limit_rad = limit_deg(random) * kDegree;
      cable::ThetaVector theta_rad{};
      const bool at_stops = i % 3 == 0;
      for (std::size_t k = 0; k < zeros(robot).size(); ++k) {
        const double drawn = share(random);
        theta_rad[k] = robot.table.segment[k / 2].theta_limit_rad * (at_stops ? (drawn < 0 ? -1.0 : 1.0) : drawn);
      }
      const std::string said = said_of(robot, {tip(forward_kinematics(robot.table, theta_rad).tip_in_base)});
      EXPECT_TRUE(said == "found" || said.starts_with("note: ")) << name << " " << i << ": " << said;
      ++looked_at;
    }
  }
  EXPECT_EQ(looked_at, 120);
}

TEST(MissionGoals, WhatIsHeldOnTheWayIsHeldAtTheGoal) {
  const config::RobotConfig robot = robot_for_kinematics("zhu2022");
  cable::ThetaVector theta_rad{};
  for (std::size_t k = 0; k < 10; ++k) theta_rad[k] = (k % 2 == 0 ? 4.0 : -3.0) * kDegree;
  Json mission = mission_to({tip(forward_kinematics(robot.table, theta_rad).tip_in_base)});
  mission["steps"][0]["goal_hold"] = Json::array({{{"theta", 9}, {"target_deg", 4.0}}});
  EXPECT_TRUE(look_at_tip_goals(mission, robot, zeros(robot)).empty());
  mission["steps"][0]["goal_hold"] = Json::array();
  for (int theta = 1; theta <= 10; ++theta)
    mission["steps"][0]["goal_hold"].push_back({{"theta", theta}, {"target_deg", 0.0}});
  EXPECT_EQ(look_at_tip_goals(mission, robot, zeros(robot)).size(), 1u) << "held straight it is not there";
}

TEST(MissionGoals, OfASerialArmAreLookedForToo) {
  const auto robot = serial_robot_for_kinematics("micro");
  ASSERT_TRUE(robot.has_value());
  const std::vector<double>& pose_deg = robot->named_poses_deg.at("prepare");
  serial::JointVector joint_rad{};
  for (std::size_t i = 0; i < pose_deg.size(); ++i) joint_rad[i] = pose_deg[i] * kDegree;
  const Json there = tip(serial::forward_kinematics(robot->table, joint_rad).tip_in_base);
  EXPECT_TRUE(look_at_tip_goals(mission_to({there}), *robot, pose_deg).empty());
  const Json inside_its_base(std::vector<double>{0.0, 0.0, 0.01, 1, 0, 0, 0});
  EXPECT_LE(look_at_tip_goals(mission_to({inside_its_base}), *robot, pose_deg).size(), 1u);
  const Json far_away(std::vector<double>{30.0, 0.0, 0.0, 1, 0, 0, 0});
  const std::vector<std::string> notes = look_at_tip_goals(mission_to({far_away}), *robot, pose_deg);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_TRUE(names(notes[0], {"liana ik"}));
}

}  // namespace
}  // namespace liana::launcher
