#include "host/apps/cli/arguments.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "host/apps/launcher/errors.hpp"

namespace liana::cli {
namespace {

cable::RobotParams two_segments() {
  cable::RobotParams robot;
  robot.segment_count = 2;
  for (cable::SegmentParams& segment : robot.segment) segment.theta_limit_rad = 20.0 * std::numbers::pi / 180.0;
  return robot;
}

std::string refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const launcher::BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(Arguments, ReadFiniteNumbersOnly) {
  EXPECT_EQ(parse_number("--x", "-8.5"), -8.5);
  EXPECT_EQ(parse_number("--x", "+1e-3"), 1e-3);
  for (const char* text : {"", "nan", "inf", "1.0x", "0x10", "1,2", " 1", "1e999"}) {
    EXPECT_NE(refusal([&] { parse_number("--x", text); }).find("--x"), std::string::npos) << text;
  }
}

TEST(Arguments, AnglesAreConvertedToRadiansAndMayStandOnTheLimit) {
  const cable::ThetaVector theta = parse_theta_deg("--theta-deg", "20,-20,0,10", two_segments());
  EXPECT_DOUBLE_EQ(theta[0], 20.0 * std::numbers::pi / 180.0);
  EXPECT_DOUBLE_EQ(theta[3], 10.0 * std::numbers::pi / 180.0);
}

TEST(Arguments, AnglesOverTheLimitOrOfTheWrongNumberAreRefusedByName) {
  const cable::RobotParams robot = two_segments();
  EXPECT_NE(refusal([&] { parse_theta_deg("--theta-deg", "0,0,20.001,0", robot); }).find("theta 3 from -20 to 20 deg"),
            std::string::npos);
  EXPECT_NE(refusal([&] { parse_theta_deg("--theta-deg", "0,0,0", robot); }).find("4 numbers"), std::string::npos);
  EXPECT_NE(refusal([&] { parse_theta_deg("--theta-deg", "0,0,nan,0", robot); }).find("finite"), std::string::npos);
}

TEST(Arguments, APoseNeedsAQuaternionOfUnitLength) {
  EXPECT_EQ(parse_pose("--tip", "1,2,3,1,0,0,0").position_m[2], 3.0);
  EXPECT_NO_THROW(parse_pose("--tip", "1,2,3,1.0000005,0,0,0"));
  EXPECT_NE(refusal([] { parse_pose("--tip", "1,2,3,1.00001,0,0,0"); }).find("1e-6"), std::string::npos);
  EXPECT_NE(refusal([] { parse_pose("--tip", "1,2,3,0,0,0,0"); }), "");
}

TEST(Arguments, HeldAnglesAreCountedFromOneAndMayCarryAValue) {
  const auto holds = parse_hold("3=0.5,1", two_segments());
  ASSERT_EQ(holds.size(), 2u);
  EXPECT_EQ(holds[0].theta, 3);
  EXPECT_EQ(holds[0].value_deg, 0.5);
  EXPECT_FALSE(holds[1].has_value);
}

TEST(Arguments, HoldsOutsideTheRobotAreRefused) {
  const cable::RobotParams robot = two_segments();
  for (const char* text : {"0", "5", "1,1", "1=21", "x", "1=", ""})
    EXPECT_NE(refusal([&] { parse_hold(text, robot); }), "") << text;
}

TEST(Arguments, AControlPointHasANodeAPlaceAndAPositiveWeight) {
  const cable::RobotParams robot = two_segments();
  const ControlPointArgument point = parse_control_point("2:1,2,3:0.5", robot);
  EXPECT_EQ(point.node, 2);
  EXPECT_EQ(point.position_m[1], 2.0);
  EXPECT_EQ(point.weight, 0.5);
  EXPECT_EQ(parse_control_point("1:0,0,0", robot).weight, 1.0);
  for (const char* text : {"3:0,0,0", "1:0,0", "1", "1:0,0,0:0", "1:0,0,0:-1", "1:0,0,nan:1"}) {
    EXPECT_NE(refusal([&] { parse_control_point(text, robot); }), "") << text;
  }
}

}  // namespace
}  // namespace liana::cli
