#include <gtest/gtest.h>

#include <cmath>

#include "host/apps/mission_runner/json_bridge.hpp"
#include "host/apps/mission_runner/script.hpp"
#include "host/base/json/json.hpp"
#include "tests/lua/program.hpp"

namespace liana::mission_runner {
namespace {

constexpr double kTolerance = 1e-9;

// Evaluates a Lua expression with geometry, robot and theta_deg in reach.
Json evaluate_lua(const Json& theta_deg, const std::string& expression, const std::string& robot = "zhu2022") {
  Activity activity;
  Script script(ScriptLimits{}, LIANA_SOURCE_DIR "/lua", activity);
  std::string list;
  for (const auto& angle : theta_deg) list += angle.dump() + ",";
  script.run({"geometry_test.lua", "local geometry, robot, theta_deg = require 'liana.geometry', require 'robots." +
                                       robot + "', {" + list + "}\nreturn " + expression});
  return to_json(script.state(), -1, "geometry_test.lua");
}

TEST(LuaGeometry, TurnsAVectorAboutAnAxisByDegrees) {
  const Json quarter = evaluate_lua(Json::array(), "geometry.turned({2, 1, 3}, {0, 0, 90})");
  const double expected[] = {-1.0, 2.0, 3.0};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(quarter[k], expected[k], kTolerance);
  EXPECT_EQ(evaluate_lua(Json::array(), "geometry.turned({2, 1, 3}, {0, 0, 0})"), Json({2, 1, 3}));
}

TEST(LuaGeometry, AnAttitudeIsSeenInTheFrameOfAnother) {
  const double half = std::sqrt(0.5);  // quarter turns about z, then about the turned x
  const Json seen = evaluate_lua(Json::array(),
                                 "(function(r) return geometry.quaternion_between({r, 0, 0, r}, {0.5, 0.5, 0.5, 0.5}) "
                                 "end)(math.sqrt(0.5))");
  const double expected[] = {half, half, 0.0, 0.0};
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(seen[k], expected[k], kTolerance);
}

// A scene that the camera sees 0.1 m aside and a quarter turn about its slit's frame, which is drawn at x = 1.
TEST(LuaGeometry, TheTipInTheDrawingIsWhereTheSceneWouldHaveItHadItNotBeenShifted) {
  const std::string tip_in_drawing =
      "(function(seen) local arm = require('liana.arm_state').new({}, { robot = robot, period_s = 1,"
      " scene = { slit = { frame = { position_m = {1, 0, 0} } } } })"
      " arm.state = { measured_cp = {1, 0.5, 0.1}, clearance = seen }"
      " return arm.tip_in_drawing() end)";
  const Json beside =
      evaluate_lua(Json::array(), tip_in_drawing + "({ shift_m = {0, 0, 0.1}, turn_deg = {0, 0, 90} })");
  const double expected[] = {1.5, 0.0, 0.0};
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(beside[k], expected[k], kTolerance);
  EXPECT_EQ(evaluate_lua(Json::array(), tip_in_drawing + "(nil)"), Json({1, 0.5, 0.1})) << "nothing is seen";
}

Json golden_cases() { return Json::parse(read_file(LIANA_SOURCE_DIR "/tests/golden/arm.json"))["cases"]; }

// req:A35 req:A51
TEST(LuaGeometry, TipAndSegmentEndsAgreeWithTheGoldenValues) {
  for (const auto& golden : golden_cases()) {
    const auto ends = evaluate_lua(golden["theta_deg"], "geometry.segment_ends(robot, theta_deg)");
    for (std::size_t m = 0; m < 5; ++m) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(ends[m]["position"][k], golden["segment_ends_m"][m][k], kTolerance) << golden["name"];
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(ends[4]["rotation"][i][k], golden["tip_pose"][i][k], kTolerance) << golden["name"];
      EXPECT_NEAR(ends[4]["position"][i], golden["tip_pose"][i][3], kTolerance) << golden["name"];
    }
  }
}

TEST(LuaGeometry, TipOfASerialArmAgreesWithTheGoldenValues) {
  const Json cases = Json::parse(read_file(LIANA_SOURCE_DIR "/tests/golden/micro.json"))["cases"];
  for (const auto& golden : cases) {
    const auto tip = evaluate_lua(golden["joint_deg"], "geometry.tip(robot, theta_deg)", "micro");
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(tip["rotation"][i][k], golden["tip_pose"][i][k], kTolerance) << golden["name"];
      EXPECT_NEAR(tip["position"][i], golden["tip_pose"][i][3], kTolerance) << golden["name"];
    }
  }
}

// Rebuilds the rotation from the quaternion, for poses that need each of its four branches.
TEST(LuaGeometry, QuaternionIsTheRotationAndHasUnitLength) {
  const std::vector<std::string> rotations = {"geometry.tip(robot, theta_deg).rotation", "{{1,0,0},{0,-1,0},{0,0,-1}}",
                                              "{{-1,0,0},{0,1,0},{0,0,-1}}", "{{-1,0,0},{0,-1,0},{0,0,1}}",
                                              "{{0,0,1},{1,0,0},{0,1,0}}"};
  for (const std::string& rotation : rotations) {
    const auto r = evaluate_lua(golden_cases()[0]["theta_deg"], rotation);
    const auto q = evaluate_lua(golden_cases()[0]["theta_deg"], "geometry.quaternion(" + rotation + ")");
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    EXPECT_NEAR(w * w + x * x + y * y + z * z, 1.0, 1e-12);
    EXPECT_GE(w, 0.0);
    EXPECT_NEAR(r[0][0].get<double>(), 1 - 2 * (y * y + z * z), kTolerance) << rotation;
    EXPECT_NEAR(r[1][0].get<double>(), 2 * (x * y + w * z), kTolerance) << rotation;
    EXPECT_NEAR(r[2][0].get<double>(), 2 * (x * z - w * y), kTolerance) << rotation;
    EXPECT_NEAR(r[2][1].get<double>(), 2 * (y * z + w * x), kTolerance) << rotation;
  }
}

// req:B16
TEST(LuaGeometry, APoseBehindItsInverseIsNone) {
  const auto none = evaluate_lua(
      golden_cases()[0]["theta_deg"],
      "geometry.compose({1, -2, 3, 0.5, 0.5, -0.5, 0.5}, geometry.inverse({1, -2, 3, 0.5, 0.5, -0.5, 0.5}))");
  for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(none[i].get<double>(), i == 3 ? 1.0 : 0.0, kTolerance) << i;
  const auto beyond =
      evaluate_lua(golden_cases()[0]["theta_deg"],
                   "geometry.compose({1, 2, 3, math.sqrt(0.5), 0, 0, math.sqrt(0.5)}, {1, 0, 0, 1, 0, 0, 0})");
  EXPECT_NEAR(beyond[0].get<double>(), 1.0, kTolerance);
  EXPECT_NEAR(beyond[1].get<double>(), 3.0, kTolerance) << "a quarter turn about z";
}

}  // namespace
}  // namespace liana::mission_runner
