// Where a simulated arm begins, and which buses it is simulated on, when a user says nothing, a name or angles.
#include <gtest/gtest.h>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/start_pose.hpp"
#include "host/apps/launcher/tables.hpp"
#include "tests/message.hpp"

namespace liana::launcher {
namespace {

template <class Action>
std::string refusal_of(const Action& action) {
  try {
    action();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "accepted";
}

TEST(StartPose, IsTheTablesWhereNobodySaysMore) {
  EXPECT_EQ(start_pose_of(robot_for_kinematics("three_segment_lab"), "").text, "park");
  EXPECT_EQ(start_pose_of(robot_for_kinematics("zhu2022"), "").text, "prepare");
  config::RobotConfig robot = robot_for_kinematics("three_segment_lab");
  robot.start_pose.clear();
  EXPECT_EQ(start_pose_of(robot, "").text, "zero") << "it has no pose called prepare";
}

TEST(StartPose, IsANameOrAllAnglesWithinTheirRange) {
  const config::RobotConfig robot = robot_for_kinematics("three_segment_lab");
  EXPECT_EQ(start_pose_of(robot, "look").angles_deg, (std::vector<double>{-6, 3, 5, -5, 8, 4}));
  EXPECT_EQ(start_pose_of(robot, "1,-2.5,0,0,15,-15").angles_deg, (std::vector<double>{1, -2.5, 0, 0, 15, -15}));
  const auto refusal = [&](const char* given) { return refusal_of([&] { start_pose_of(robot, given); }); };
  EXPECT_TRUE(names(refusal("nowhere"), {"--start-pose", "nowhere", "three_segment_lab", "deep", "jig_a"}));
  for (const char* given : {"1,2,3", "1,2,3,4,5,6,7", "1,2,3,4,5,", "1,2,3,4,5,x", "nan,0,0,0,0,0", "15.01,0,0,0,0,0"})
    EXPECT_TRUE(names(refusal(given), {"--start-pose", "three_segment_lab"})) << given;
  EXPECT_NE(refusal("0,0,16,0,0,0").find("angle 3 in"), std::string::npos);
}

TEST(StartPose, InsideABodyIsRefusedWithTheBodysNameAndTheLink) {
  const config::RobotConfig robot = robot_for_kinematics("three_segment_lab");
  const config::SceneConfig scene = scene_of("lab_box");
  EXPECT_EQ(refusal_of([&] { check_start_is_free(robot, scene, start_pose_of(robot, "")); }), "accepted");
  const std::string refusal = refusal_of([&] { check_start_is_free(robot, scene, start_pose_of(robot, "deep")); });
  EXPECT_TRUE(names(refusal, {"floor"}));
  EXPECT_NE(refusal.find("link "), std::string::npos) << refusal;
}

TEST(StartPose, OfASerialArmInsideABodyOrItselfIsRefused) {
  const config::SerialRobotConfig robot = *serial_robot_for_kinematics("micro");
  config::SceneConfig scene = scene_of("none");
  const StartPose prepare = start_pose_of(robot, "prepare");
  EXPECT_EQ(refusal_of([&] { check_start_is_free(robot, scene, prepare); }), "accepted");
  scene.spheres.push_back({"ball", {0.0, 0.0, 0.2}, 0.1});
  const std::string in_ball = refusal_of([&] { check_start_is_free(robot, scene, prepare); });
  EXPECT_TRUE(names(in_ball, {"pose prepare", "link 1", "170.0 mm", "ball"}));
  const StartPose folded = start_pose_of(robot, "0,0,0,180,0,0,0");
  const std::string in_itself = refusal_of([&] { check_start_is_free(robot, scene_of("none"), folded); });
  EXPECT_NE(in_itself.find("inside link "), std::string::npos) << in_itself;
}

TEST(StartPose, ABentPoseIsFoundByItsAnglesAndNotByItsName) {
  EXPECT_EQ(bent_pose(""), "jig");
  EXPECT_EQ(bent_pose("three_segment_lab"), "jig_a");
}

TEST(Buses, AreTheUsersElseTheRobotsOwnElseMadeForItsDrives) {
  const auto name = [](const char* robot, const std::string& given) {
    return buses_of(robot, evaluate_table("robot", robot), given).name;
  };
  EXPECT_EQ(name("zhu2022", ""), "embedded");
  EXPECT_EQ(name("zhu2022", "embedded_500"), "embedded_500");
  EXPECT_EQ(name("three_segment_lab", ""), "embedded_three_segment_lab");
  EXPECT_EQ(name("tdcr_benchmark", ""), "bench_6");
  EXPECT_EQ(name("micro", ""), "embedded_micro");
  EXPECT_EQ(name("macro_micro", ""), "embedded_macro_micro");
  EXPECT_EQ(name("macro_micro_stiff", ""), "embedded_macro_micro_stiff");
}

}  // namespace
}  // namespace liana::launcher
