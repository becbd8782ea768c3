#include "host/model/config/serial_robot.hpp"

#include <cmath>

#include "tests/host/model/config/tables.hpp"

namespace liana::config {
namespace {

BusesConfig micro_buses() { return parse_buses(good_table("buses", "embedded_micro").dump(), "b"); }

SerialRobotConfig micro() { return parse_serial_robot(good_table("robot", "micro").dump(), "r", micro_buses()); }

// req:B1
TEST(SerialRobot, BecomesTheTableTheCoreReads) {
  const SerialRobotConfig robot = micro();
  EXPECT_EQ(robot.name, "micro");
  EXPECT_EQ(robot.table.joint_count, 7);
  EXPECT_DOUBLE_EQ(robot.table.joint[5].dh.alpha_rad, -90 * kDeg);
  EXPECT_EQ(robot.table.joint[2].dh.a_m, 2.10);
  EXPECT_EQ(robot.table.joint[6].dh.d_m, 0.28);
  EXPECT_DOUBLE_EQ(robot.table.joint[3].low_rad, -270 * kDeg);
  EXPECT_DOUBLE_EQ(robot.table.joint[3].rate_rad_s, 4 * kDeg);
  EXPECT_DOUBLE_EQ(robot.table.drive[0].rad_per_count, 2 * 3.14159265358979323846 / 1048576);
  EXPECT_DOUBLE_EQ(robot.table.drive[0].torque_per_permille_Nm, 0.15);
  EXPECT_EQ(robot.table.drive[1].direction, -1);
  EXPECT_DOUBLE_EQ(robot.table.tip.rate_rad_s, 3 * kDeg);
  EXPECT_DOUBLE_EQ(robot.table.tick_s, 0.004);
  EXPECT_EQ(robot.table.interval_ticks, 5);
  EXPECT_EQ(robot.named_poses_deg.at("install")[3], 139);
}

TEST(SerialRobot, EveryTableSaysItsKind) {
  EXPECT_EQ(robot_kind(good_table("robot", "micro").dump(), "r"), "serial");
  EXPECT_EQ(robot_kind(good_table("robot", "zhu2022").dump(), "r"), "robot");
  EXPECT_EQ(robot_kind("[]", "r"), "");
}

TEST(SerialRobot, IsRefusedWithFileFieldValueRangeAndAdvice) {
  const Json good = good_table("robot", "micro");
  const auto nine = Json(std::vector<Json>(9, good["joints"][0]));
  const auto five = Json(std::vector<Json>(5, good["joints"][0]));
  Json short_joint = good["joints"][0];
  short_joint["a_m"] = short_joint["d_m"] = 0.001;
  const std::vector<Spoiled> cases = {
      {"/format", 2, "format", {"1", "1"}},
      {"/joints", Json(std::vector<Json>(6, short_joint)), "joints", {"10"}},
      {"/kind", "robot", "kind", {"serial"}},
      {"/colour", "red", "colour", {"field"}},
      {"/joints", nine, "joints", {"kMaxJoints"}},  // compiled capacity, by name
      {"/joints", five, "joints", {"6", "8"}},
      {"/joints/2/alpha_deg", 200, "joints[3].alpha_deg", {"-180", "180"}},
      {"/joints/2/a_m", "long", "joints[3].a_m", {"number"}},
      {"/joints/2/d_m", nullptr, "joints[3].d_m", {"missing"}},
      {"/joints/2/high_deg", -270, "joints[3].high_deg", {"-269", "720"}},
      {"/joints/6/rate_deg_s", 0, "joints[7].rate_deg_s", {"0.001", "360"}},
      {"/joints/6/wobble", 1, "joints[7].wobble", {"field"}},
      {"/joints/3/stiffness_Nm_per_rad", 0, "joints[4].stiffness_Nm_per_rad", {"1"}},
      {"/joints/3/stiffness_Nm_per_rad", nullptr, "joints[4]", {"stiffness_Nm_per_rad"}},
      {"/joints/3/link", Json{{"mass_kg", 1}}, "joints[4]", {"link"}},
      {"/mass/boom_kg", -1, "mass.boom_kg", {"0.01", "100000"}},
      {"/mass/boom_radius_m", 0, "mass.boom_radius_m", {"0.001", "5"}},
      {"/friction/gear_damping_Nms_per_rad", -1, "friction.gear_damping_Nms_per_rad", {"0"}},
      {"/drives/peak_torque_Nm", 149, "drives.peak_torque_Nm", {"150", "450"}},
      {"/friction/coulomb_Nm", -1, "friction.coulomb_Nm", {"0"}},
      {"/drives/direction/3", 0, "drives.direction[4]", {"1", "-1"}},
      {"/drives/zero_counts", {1, 2, 3}, "drives.zero_counts", {"3", "entries"}},
      {"/drives/gear", 1e-9, "drives.gear", {"0.01", "1000"}},
      {"/drives/serials", {1, 2, 3, 4, 5, 6, 2}, "drives.serials[7]", {"2"}},
      {"/drives/identity/vendor", -1, "drives.identity.vendor", {"0", "4294967295"}},
      {"/limits/tip_speed_m_s", 3, "limits.tip_speed_m_s", {"1e-04", "2"}},
      {"/limits/cable_speed_m_s", 3, "limits.cable_speed_m_s", {"field"}},
      {"/named_poses_deg/prepare/3", 270.5, "named_poses_deg.prepare[4]", {"-270", "270"}},
      {"/named_poses_deg/prepare", {0, 0}, "named_poses_deg.prepare", {"7"}}};
  for (const Spoiled& spoiled : cases) {
    expect_refused(good, spoiled,
                   [](const std::string& text) { parse_serial_robot(text, "given.json", micro_buses()); });
  }
}

// The table with a link of 10 kg at every joint instead of modules and booms.
Json with_links(const std::vector<double>& inertia_kgm2) {
  Json table = good_table("robot", "micro");
  table.erase("mass");
  for (std::size_t i = 0; i < 7; ++i)
    table["joints"][i]["link"] = Json{{"mass_kg", 10}, {"center_m", {0.1, 0, 0}}, {"inertia_kgm2", inertia_kgm2}};
  return table;
}

TEST(SerialRobot, LinksMayBeSaidOneByOne) {
  const SerialRobotConfig robot = parse_serial_robot(with_links({1, 2, 2.5, 0.1, 0.2, 0.3}).dump(), "r");
  EXPECT_EQ(robot.masses.link[6].mass_kg, 10.0);
  EXPECT_EQ(robot.masses.link[6].center_m[0], 0.1);
  EXPECT_EQ(robot.masses.link[6].inertia_kgm2[serial::kYz], 0.3);
  EXPECT_NO_THROW(parse_serial_robot(with_links({1, 1, 2, 0, 0, 0}).dump(), "r")) << "a plate";
}

TEST(SerialRobot, LinksThatNoBodyCanBeAreRefused) {
  const auto parse = [](const std::string& text) { parse_serial_robot(text, "given.json"); };
  const std::vector<std::vector<double>> impossible{
      {1, 1, 2.1, 0, 0, 0}, {1, 1, 1, 0.6, 0, 0}, {1, 1, 1, 0.4, 0.4, 0.4}};
  EXPECT_NO_THROW(parse(with_links({1, 1, 1, 0.4, 0.4, -0.4}).dump())) << "long along (1, -1, -1)";
  for (const std::vector<double>& inertia : impossible) {
    expect_refused(with_links({1, 1, 1, 0, 0, 0}),
                   {"/joints/2/link/inertia_kgm2", inertia, "joints[3].link.inertia_kgm2", {"moments"}}, parse);
  }
  Json both = with_links({1, 1, 1, 0, 0, 0});
  expect_refused(both, {"/mass", Json{{"module_kg", 1}}, "mass", {"module_kg"}}, parse);
}

TEST(SerialRobot, ABaseIsALockedArmThatSaysHowItGivesWay) {
  const Json good = good_table("robot", "macro_micro");
  const auto parse = [](const std::string& text) { parse_serial_robot(text, "given.json"); };
  const Json macro = good["base"]["robot"];
  const std::vector<Spoiled> cases = {
      {"/base/pose", "nowhere", "base.pose", {"install"}},
      {"/base/damping_s", 1.5, "base.damping_s", {"0", "1"}},
      {"/base/robot/mass/boom_kg", 0, "base.robot.mass.boom_kg", {"0.01"}},
      {"/base/robot/joints/2/stiffness_Nm_per_rad", nullptr, "base.robot.joints[3]", {"stiffness_Nm_per_rad"}},
      {"/base/robot/kind", "robot", "base.robot.kind", {"serial"}},
      {"/base/robot/base", macro, "base.robot.base", {"base"}},
      {"/base/wobble", 1, "base.wobble", {"field"}}};
  for (const Spoiled& spoiled : cases) expect_refused(good, spoiled, parse);
}

// req:B17 req:B20
TEST(SerialRobot, TorqueDrivesHaveMassesGainsAndBounds) {
  const BusesConfig buses = parse_buses(good_table("buses", "embedded_payload").dump(), "b");
  const SerialRobotConfig robot = parse_serial_robot(good_table("robot", "macro_micro").dump(), "r", buses);
  const serial::TorqueParams& torque = robot.table.torque;
  EXPECT_TRUE(is_torque_controlled(robot));
  EXPECT_FALSE(is_torque_controlled(micro()));
  EXPECT_TRUE(robot.has_wrist_sensor);
  EXPECT_FALSE(micro().has_wrist_sensor);
  EXPECT_EQ(torque.masses.link[6].mass_kg, robot.masses.link[6].mass_kg);
  EXPECT_EQ(torque.most_force_N, 60.0);
  EXPECT_EQ(torque.most_joint_Nm, 100.0);
  EXPECT_EQ(robot.push_gains[serial::kAxialDamping], 2400.0);
  EXPECT_EQ(torque.gain_low[serial::kAxialDamping], 800.0);
  EXPECT_EQ(torque.gain_high[serial::kAxialDamping], 8000.0);
}

TEST(SerialRobot, TorqueDrivesAreRefusedByFieldWhereSomethingIsMissingOrOutOfRange) {
  const Json good = good_table("robot", "macro_micro");
  const auto parse = [](const std::string& text) { parse_serial_robot(text, "given.json"); };
  const std::vector<Spoiled> cases = {
      {"/drives/mode", "speed", "drives.mode", {"torque"}},
      {"/drives/mode", nullptr, "force_control", {"drives.mode"}},
      {"/drives/position_gain_per_s", nullptr, "drives.position_gain_per_s", {"missing"}},
      {"/force_control", nullptr, "force_control", {"missing"}},
      {"/force_control/max_joint_Nm", 151, "force_control.max_joint_Nm", {"1", "150"}},
      {"/force_control/gains/mass_kg", Json{500, 600, 5000}, "force_control.gains.mass_kg[1]", {"600", "5000"}},
      {"/force_control/gains/mass_kg", Json{500, 50}, "force_control.gains.mass_kg", {"least", "most"}},
      {"/force_control/gains/wobble", Json{1, 1, 1}, "force_control.gains.wobble", {"field"}}};
  for (const Spoiled& spoiled : cases) expect_refused(good, spoiled, parse);
}

TEST(SerialRobot, ItsDrivesFollowWhatTheTypesOfItsBusesFollow) {
  const auto on = [](const char* robot, const char* buses) {
    try {
      parse_serial_robot(good_table("robot", robot).dump(), "r", parse_buses(good_table("buses", buses).dump(), "b"));
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_EQ(on("micro", "embedded_micro"), "accepted");
  EXPECT_EQ(on("macro_micro", "embedded_payload"), "accepted");
  EXPECT_EQ(on("macro_micro", "embedded_macro_micro"), "accepted");
  EXPECT_EQ(on("macro_micro_stiff", "embedded_macro_micro_stiff"), "accepted");
  EXPECT_TRUE(names(on("macro_micro", "embedded_micro"), {"node 1", "embedded_micro", "cia402_csp"}));
  EXPECT_TRUE(names(on("micro", "embedded_payload"), {"node 1", "embedded_payload", "positions"}));
}

TEST(SerialRobot, CountsThatNoDriveCanHoldAreRefused) {
  Json table = good_table("robot", "micro");
  table["drives"]["counts_per_turn"] = 16777216;
  expect_refused(table, {"/drives/gear", 1000, "drives.zero_counts[1]", {"counts"}},
                 [](const std::string& text) { parse_serial_robot(text, "given.json", micro_buses()); });
}

TEST(SerialRobot, NeedsEveryDriveOnABusAndNoOther) {
  const std::string robot = good_table("robot", "micro").dump();
  Json table = good_table("buses", "embedded_micro");
  table["buses"][1]["nodes"] = {5, 6};
  EXPECT_THROW(parse_serial_robot(robot, "r", parse_buses(table.dump(), "b")), std::runtime_error);
  table["buses"][1]["nodes"] = {5, 6, 7, 8};
  EXPECT_THROW(parse_serial_robot(robot, "r", parse_buses(table.dump(), "b")), std::runtime_error);
  EXPECT_NO_THROW(
      parse_serial_robot(robot, "r", parse_buses(good_table("buses", "embedded_micro_single").dump(), "b")));
}

TEST(SerialRobot, TheTwoKindsAreNotTakenForEachOther) {
  EXPECT_THROW(parse_serial_robot(good_table("robot", "zhu2022").dump(), "r", micro_buses()), std::runtime_error);
  EXPECT_THROW(parse_robot(good_table("robot", "micro").dump(), "r", "nominal", micro_buses()), std::runtime_error);
}

}  // namespace
}  // namespace liana::config
