#include <cmath>
#include <functional>

#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::config {
namespace {

BusesConfig buses() { return parse_buses(good_table("buses", "embedded").dump(), "b"); }

// Mission, A1 and A9.
// req:A2 req:A5
TEST(Robot, BecomesTheTableTheCoreReads) {
  const RobotConfig robot = parse_robot(good_table("robot", "zhu2022").dump(), "r", "nominal", buses());
  EXPECT_EQ(robot.table.theta_count(), 10);
  EXPECT_EQ(robot.table.cable_count(), 15);
  EXPECT_DOUBLE_EQ(robot.table.segment[4].theta_limit_rad, 20 * kDeg);
  EXPECT_DOUBLE_EQ(robot.table.segment[1].cable_phase_rad[2], 264 * kDeg);
  EXPECT_DOUBLE_EQ(robot.table.drive[1].metres_per_count, 2 * 3.14159265358979323846 * 0.015 / 65536);
  EXPECT_EQ(robot.table.drive[1].direction, -1);
  EXPECT_DOUBLE_EQ(robot.table.drive[0].newtons_per_permille, 0.6);
  EXPECT_DOUBLE_EQ(robot.table.tick_s, 0.004);
  EXPECT_EQ(robot.table.interval_ticks, 5);
  EXPECT_EQ(robot.identity.vendor, 0x4C49u);
  EXPECT_EQ(robot.named_poses_deg.at("prepare")[0], -8.5);
}

TEST(Robot, PhysicsNameChoosesTheFrictionTheCoreIsTold) {
  const std::string text = good_table("robot", "zhu2022").dump();
  EXPECT_EQ(parse_robot(text, "r", "nominal", buses()).table.friction_mu, 0.05);
  EXPECT_EQ(parse_robot(text, "r", "ideal", buses()).table.friction_mu, 0.0);
  EXPECT_EQ(parse_robot(text, "r", "worn", buses()).table.friction_mu, 0.10);
  EXPECT_THROW(parse_robot(text, "r", "rusty", buses()), std::runtime_error);
}

TEST(Robot, IsRefusedWithFileFieldValueRangeAndAdvice) {
  const Json good = good_table("robot", "zhu2022");
  const auto nine = Json(std::vector<Json>(9, good["segments"][0]));
  const std::vector<Spoiled> cases = {
      {"/format", 2, "format", {"1", "1"}},
      {"/kind", "scene", "kind", {"robot"}},
      {"/name", "a b", "name", {"a b"}},
      {"/colour", "red", "colour", {"field"}},
      {"/module/radius_m", -0.03, "module.radius_m", {"5e-04", "0.5"}},
      {"/module/mass_kg", 1e-300, "module.mass_kg", {"1e-06", "100"}},
      {"/module/center", 1.01, "module.center", {"0", "1"}},
      {"/gravity_m_s2", {0, 0, -31}, "gravity_m_s2[3]", {"-30", "30"}},
      {"/gravity_m_s2", {0, -9.81}, "gravity_m_s2", {"2", "3"}},
      {"/tool", {{"mass_kg", -0.1}, {"center_m", {0, 0, 0}}}, "tool.mass_kg", {"0", "100"}},
      {"/tool", {{"mass_kg", 1}}, "tool.center_m", {"missing"}},
      {"/tool", {{"mass_kg", 1}, {"center_m", {0, 0, 1.5}}}, "tool.center_m[3]", {"-1", "1"}},
      {"/joint/stiffness_Nm_per_rad", -1, "joint.stiffness_Nm_per_rad", {"0", "10000"}},
      {"/joint/rest_deg", {0, 46}, "joint.rest_deg[2]", {"-45", "45"}},
      {"/segments/1/module_mass_kg", 0, "segments[2].module_mass_kg", {"1e-06", "100"}},
      {"/segments/1/joint_rest_deg", {1}, "segments[2].joint_rest_deg", {"1", "2"}},
      {"/segments", nine, "segments", {"kMaxSegments"}},  // compiled capacity, by name
      {"/segments/0/modules", 17, "segments[1].modules", {"1", "16"}},
      {"/segments/2/module_length_m", "long", "segments[3].module_length_m", {"number"}},
      {"/segments/2/modules", 2.5, "segments[3].modules", {"whole"}},
      {"/segments/4/theta_limit_deg", nullptr, "segments[5].theta_limit_deg", {"missing"}},
      {"/cables/phase_deg/0", {0, 10, 20}, "cables.phase_deg[1]", {"pull"}},
      {"/cables/phase_deg/0", {0, 120}, "cables.phase_deg[1]", {"3", "5", "2"}},
      {"/cables/phase_deg/0", {0, 60, 120, 180, 240, 300}, "cables.phase_deg[1]", {"3", "5", "entries"}},
      {"/cables/hole_radius_m", 0.04, "cables.hole_radius_m", {"2e-04", "0.03"}},
      {"/cables/hole_radius_m", {0.02, 0.02, 0.02}, "cables.hole_radius_m", {"3", "5"}},
      {"/cables/hole_radius_m", {0.02, 0.02, 0.02, 0.04, 0.02}, "cables.hole_radius_m[4]", {"2e-04", "0.03"}},
      {"/cables/hole_radius_m", "wide", "cables.hole_radius_m", {"number"}},
      {"/cables/face_offset_m", 0.05, "cables.face_offset_m", {"1e-05", "0.049"}},
      {"/cables/face_offset_m", {0.01, 0.05, 0.01, 0.01, 0.01}, "cables.face_offset_m[2]", {"1e-05", "0.049"}},
      {"/cables/friction_mu/worn", 0.9, "cables.friction_mu.worn", {"0", "0.5"}},
      {"/cables/EA_N", true, "cables.EA_N", {"number"}},
      {"/tension/floor_motor_N", 50, "tension.plan_N", {"50"}},
      {"/tension/hard_limit_N", 300, "tension.hard_limit_N", {"400"}},
      {"/drives/rated_torque_Nm", 8, "drives.rated_torque_Nm", {"9"}},
      {"/drives/direction/3", 0, "drives.direction[4]", {"1", "-1"}},
      {"/drives/zero_counts", {1, 2, 3}, "drives.zero_counts", {"3", "entries"}},
      {"/drives/serials", {1, 2, 3}, "drives.serials", {"3", "entries"}},
      {"/drives/serials", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 2}, "drives.serials[15]", {"2"}},
      {"/drives/serials", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 0}, "drives.serials[15]", {"1"}},
      {"/drives/identity/vendor", -1, "drives.identity.vendor", {"0", "4294967295"}},
      {"/limits/tip_speed_slit_m_s", 0.2, "limits.tip_speed_slit_m_s", {"1e-06", "0.1"}},
      {"/limits/tip_lag_s", 0.2, "limits.tip_lag_s", {"0.25", "5", "tip_accel_m_s2", "tip_jerk_m_s3"}},
      {"/limits/tip_lag_s", -1, "limits.tip_lag_s", {"0", "5"}},
      {"/limits/tip_angular_accel_deg_s2", 20, "limits.tip_lag_s", {"0.51", "5", "tip_angular_accel_deg_s2"}},
      {"/limits/theta_rate_deg_s", 0, "limits.theta_rate_deg_s", {"0.001", "90"}},
      {"/limits/theta_accel_deg_s2", 1e-12, "limits.theta_accel_deg_s2", {"0.001", "1000"}},
      {"/drives/gear", 1e-9, "drives.gear", {"0.01", "1000"}},
      {"/drives/drum_radius_m", 1e-9, "drives.drum_radius_m", {"0.001", "0.5"}},
      {"/named_poses_deg/zero", nullptr, "named_poses_deg.zero", {"missing"}},
      {"/named_poses_deg/prepare/3", 20.5, "named_poses_deg.prepare[4]", {"-20", "20"}},
      {"/named_poses_deg/prepare", {0, 0}, "named_poses_deg.prepare", {"10"}}};
  for (const Spoiled& spoiled : cases) {
    expect_refused(good, spoiled, [](const std::string& text) { parse_robot(text, "given.json", "nominal", buses()); });
  }
}

TEST(Robot, AGearMakesCountsFinerAndTorqueAtTheDrumStaysWhatItIs) {
  Json table = good_table("robot", "zhu2022");
  for (const double gear : {1.0, 5.0, 0.2}) {
    table["drives"]["gear"] = gear;
    const cable::DriveParams drive = parse_robot(table.dump(), "r", "nominal", buses()).table.drive[0];
    EXPECT_DOUBLE_EQ(drive.metres_per_count * gear, 0.015 * 360 * kDeg / 65536);
    EXPECT_DOUBLE_EQ(drive.newtons_per_permille, 0.6);
  }
}

TEST(Robot, SegmentsHaveTheLoadOfAllUnlessTheySayOtherwise) {
  Json table = good_table("robot", "zhu2022");
  const RobotConfig weightless = parse_robot(table.dump(), "r", "nominal", buses());
  EXPECT_EQ(weightless.table.gravity_m_s2, (Vec3{}));
  EXPECT_EQ(weightless.table.segment[0].module_center, 0.5);
  table["gravity_m_s2"] = {1, 2, -9};
  table["tool"] = {{"mass_kg", 0.2}, {"center_m", {0.01, 0, 0.02}}};
  table["module"]["center"] = 0.4;
  table["joint"]["stiffness_Nm_per_rad"] = 3;
  table["joint"]["rest_deg"] = {2, -1};
  table["segments"][4]["module_mass_kg"] = 0.25;
  table["segments"][4]["module_center"] = 0.6;
  table["segments"][4]["joint_stiffness_Nm_per_rad"] = 0;
  table["segments"][4]["joint_rest_deg"] = {0, 5};
  const cable::RobotParams robot = parse_robot(table.dump(), "r", "nominal", buses()).table;
  EXPECT_EQ(robot.gravity_m_s2, (Vec3{1, 2, -9}));
  EXPECT_EQ(robot.tool.mass_kg, 0.2);
  EXPECT_EQ(robot.tool.center_in_tip_m, (Vec3{0.01, 0, 0.02}));
  for (const std::size_t m : {0u, 3u}) {
    EXPECT_EQ(robot.segment[m].module_mass_kg, 0.3);
    EXPECT_EQ(robot.segment[m].module_center, 0.4);
    EXPECT_EQ(robot.segment[m].joint_stiffness_Nm_rad, 3.0);
    EXPECT_DOUBLE_EQ(robot.segment[m].joint_rest_rad[0], 2 * kDeg);
    EXPECT_DOUBLE_EQ(robot.segment[m].joint_rest_rad[1], -1 * kDeg);
  }
  EXPECT_EQ(robot.segment[4].module_mass_kg, 0.25);
  EXPECT_EQ(robot.segment[4].module_center, 0.6);
  EXPECT_EQ(robot.segment[4].joint_stiffness_Nm_rad, 0.0);
  EXPECT_DOUBLE_EQ(robot.segment[4].joint_rest_rad[1], 5 * kDeg);
}

TEST(Robot, HoleRadiusAndFaceOffsetAreOneNumberOrOneForEachSegment) {
  Json table = good_table("robot", "zhu2022");
  table["cables"]["hole_radius_m"] = {0.025, 0.024, 0.023, 0.022, 0.021};
  table["cables"]["face_offset_m"] = {0.01, 0.009, 0.008, 0.007, 0.006};
  const cable::RobotParams even = parse_robot(good_table("robot", "zhu2022").dump(), "r", "nominal", buses()).table,
                           uneven = parse_robot(table.dump(), "r", "nominal", buses()).table;
  for (std::size_t m = 0; m < 5; ++m) {
    EXPECT_EQ(even.segment[m].hole_radius_m, 0.025);
    EXPECT_EQ(even.segment[m].face_offset_m, 0.01);
    EXPECT_DOUBLE_EQ(uneven.segment[m].hole_radius_m, 0.025 - 0.001 * static_cast<double>(m));
    EXPECT_DOUBLE_EQ(uneven.segment[m].face_offset_m, 0.01 - 0.001 * static_cast<double>(m));
  }
}

TEST(Robot, ATableThatSaysNothingOfTheTipsLagHasThatOfSpeedAndAcceleration) {
  Json table = good_table("robot", "zhu2022");
  EXPECT_EQ(parse_robot(table.dump(), "r", "nominal", buses()).table.limits.tip_lag_s, 0.25);
  table["limits"].erase("tip_lag_s");
  EXPECT_EQ(parse_robot(table.dump(), "r", "nominal", buses()).table.limits.tip_lag_s, 0.0);
}

TEST(Robot, NeedsEveryDriveOnABusAndNoOther) {
  Json table = good_table("buses", "embedded");
  table["buses"][1]["nodes"] = {9, 10, 11, 12, 13, 14};
  const std::string robot = good_table("robot", "zhu2022").dump();
  EXPECT_THROW(parse_robot(robot, "r", "nominal", parse_buses(table.dump(), "b")), std::runtime_error);
  table["buses"][1]["nodes"] = {9, 10, 11, 12, 13, 14, 15, 16};
  EXPECT_THROW(parse_robot(robot, "r", "nominal", parse_buses(table.dump(), "b")), std::runtime_error);
}

TEST(Robot, TheAxesOfANodeHaveItsOneSerialNumberAndOtherDrivesHaveNot) {
  const auto read = [](const Json& serials, const char* on) {
    Json table = good_table("robot", "zhu2022");
    table["drives"]["serials"] = serials;
    parse_robot(table.dump(), "r", "nominal", parse_buses(good_table("buses", on).dump(), "b"));
  };
  const Json one_each = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
  const Json of_pairs = {1, 1, 3, 3, 5, 5, 7, 7, 9, 9, 11, 11, 13, 13, 15};
  EXPECT_NO_THROW(read(one_each, "embedded"));
  EXPECT_NO_THROW(read(of_pairs, "embedded_two_axes"));
  EXPECT_THROW(read(of_pairs, "embedded"), std::runtime_error);
  EXPECT_THROW(read(one_each, "embedded_two_axes"), std::runtime_error);
}

// Of every table the same reader; its entries count from 1, as in Lua.
TEST(Robot, ANumberThatNoDoubleHoldsIsRefusedWithFileFieldAndItself) {
  struct Row {
    const char* kind;
    const char* name;
    std::string field;
    std::function<void(const std::string&)> read;
  };
  const Row rows[] = {
      {"robot", "zhu2022", "limits", [](const std::string& text) { parse_robot(text, "f", "nominal", buses()); }},
      {"robot", "micro", "named_poses_deg", [](const std::string& text) { parse_serial_robot(text, "f"); }},
      {"scene", "panel_slit", "slit", [](const std::string& text) { parse_scene(text, "f"); }},
      {"buses", "embedded", "buses", [](const std::string& text) { parse_buses(text, "f"); }},
  };
  for (const Row& row : rows) {
    for (const std::string number : {"1e400", "-1e400"}) {
      Json table = good_table(row.kind, row.name);
      table[row.field] = {{"a", {0, "HERE"}}};
      std::string text = table.dump();
      text.replace(text.find("\"HERE\""), 6, number);
      try {
        row.read(text);
        ADD_FAILURE() << row.name << " was accepted";
      } catch (const std::runtime_error& error) {
        EXPECT_TRUE(names(error.what(), {"f", row.field + ".a[2]", number, "-1.797e308", "1.797e308"}));
      }
    }
  }
}

TEST(Robot, TextThatIsNoJsonIsRefusedWithItsFile) {
  try {
    parse_robot("{", "given.json", "nominal", buses());
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("given.json: not JSON"));
  }
}

TEST(Robot, AMissingFileIsNamed) {
  EXPECT_THROW(load_robot("/nonexistent/robot.json", "nominal", buses()), std::runtime_error);
}

}  // namespace
}  // namespace liana::config
