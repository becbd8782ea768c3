#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/lua/program.hpp"

namespace liana {
namespace {

TEST(Eval, PrintsTheSameCanonicalTextTwice) {
  for (const std::string table :
       {"robot zhu2022", "scene panel_slit", "buses embedded", "buses embedded_500", "buses embedded_single", "buses vcan"}) {
    const Ended first = run_program("eval " + table);
    EXPECT_EQ(first.code, 0) << first.error;
    EXPECT_EQ(first.error, "");
    EXPECT_EQ(first.out, run_program("eval " + table).out);
    EXPECT_EQ(first.out.find(' '), std::string::npos) << table;
  }
}

struct Change {
  const char* kind;
  const char* module;
  const char* statement;  // applied to table t
  const char* message;
};

// Lua tables of users, each with one mistake: the message names file, field, value, what is allowed and what to do.
TEST(Eval, RefusesMalformedLuaTablesByField) {
  const std::vector<Change> changes = {
      {"robot", "robots.zhu2022", "t.segments[2].modules = 99", "given.lua: segments[1].modules: 99: allowed 1 to 16: choose a value"},
      {"robot", "robots.zhu2022", "t.module.mass_kg = 'heavy'", "given.lua: module.mass_kg: \"heavy\": allowed a number over 0"},
      {"robot", "robots.zhu2022", "t.format = 3", "given.lua: format: 3: allowed 1 to 1"},
      {"robot", "robots.zhu2022", "t.limits.tip_speed = 1", "given.lua: limits.tip_speed: 1: allowed no such field"},
      {"robot", "robots.zhu2022", "t.limits.tip_sped_m_s, t.limits.tip_speed_m_s = t.limits.tip_speed_m_s, nil",
       "given.lua: limits.tip_sped_m_s: 0.1: allowed no such field: remove it or correct its spelling"},
      {"robot", "robots.zhu2022", "t.drives.idenity, t.drives.identity = t.drives.identity, nil", "given.lua: drives.idenity: {"},
      {"robot", "robots.zhu2022", "t.drives = nil", "given.lua: drives: missing"},
      {"robot", "robots.zhu2022", "for i = 6, 9 do t.segments[i] = t.segments[1] end",
       "given.lua: segments: 9 entries: allowed a list of 1 to 8"},
      {"scene", "scenes.panel_slit", "t.spheres[1].radius_m = -1", "given.lua: spheres[1].radius_m: -1: allowed over 0"},
      {"scene", "scenes.panel_slit", "t.boxes[1].rotation[1] = {1,1,1}", "given.lua: boxes[1].rotation: "},
      {"scene", "scenes.panel_slit", "t.rod.position_m = {1,2}", "given.lua: rod.position_m: 2 entries: allowed a list of 3 entries"},
      {"scene", "scenes.panel_slit", "t.slit.offset_m = t.slit.offset_m + 0.1", "given.lua: slit.frame.position_m: "},
      {"buses", "buses.embedded", "t.rate_hz = 300", "given.lua: rate_hz: 300: allowed rates whose period"},
      {"buses", "buses.embedded", "t.buses[1].nodes[1] = 0", "given.lua: buses[1].nodes[1]: 0: allowed 1 to 126"},
      {"buses", "buses.embedded", "t.buses[2].nodes[1] = 1", "given.lua: buses[2].nodes[1]: 1: allowed each node id once"},
      {"buses", "buses.embedded_single", "t.rate_hz = 250", "given.lua: buses[1].nodes: "},
      {"buses", "buses.embedded", "t.backend = 'ethernet'", "given.lua: backend: \"ethernet\": allowed embedded, socketcan"},
      {"buses", "buses.embedded", "t.kind = 'robot'", "given.lua: kind: \"robot\": allowed buses"}};
  const TemporaryFolder folder;
  for (const Change& change : changes) {
    const std::string file =
        folder.write("given.lua", "local t = require '" + std::string(change.module) + "'\n" + change.statement + "\nreturn t\n");
    const Ended ended = run_program("eval " + std::string(change.kind) + " " + file);
    EXPECT_EQ(ended.code, 2) << change.statement;
    EXPECT_NE(ended.error.find(change.message), std::string::npos) << change.statement << " -> " << ended.error;
    EXPECT_EQ(std::count(ended.error.begin(), ended.error.end(), '\n'), 1) << ended.error;
  }
}

TEST(Eval, NamesWhatThereIsWhenANameIsUnknown) {
  const Ended ended = run_program("eval buses can9");
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.error.find("can9: allowed embedded, embedded_500, embedded_single, vcan"), std::string::npos) << ended.error;
}

TEST(Eval, DescribesTheSlitCrossing) {
  const Ended ended = run_program("eval mission slit_crossing");
  ASSERT_EQ(ended.code, 0) << ended.error;
  const auto mission = nlohmann::json::parse(ended.out);
  ASSERT_EQ(mission["steps"].size(), 6u);  // A50: six steps
  EXPECT_EQ(mission["steps"][1]["device"], "vr");
  EXPECT_EQ(mission["steps"][4]["held_theta"], nlohmann::json({7, 9}));  // A52: X5 first, then X4
  EXPECT_EQ(mission["steps"][3]["held_theta"], nlohmann::json({9}));
}

struct BadMission {
  const char* steps;
  const char* message;
};

TEST(Eval, RefusesMalformedMissionsByStepAndField) {
  const std::vector<BadMission> missions = {
      {"", "mission m: steps: none"},
      {"step 'a' { device = 'joystick', exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "step 1 \"a\": device: joystick: allowed \"vr\""},
      {"step 'a' { device = 'none', exit = at_rest, time_limit_s = 1, on_fail = 'hold' }",
       "step 1 \"a\": exit: function: allowed a condition"},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 0, on_fail = 'hold' }", "time_limit_s: 0: allowed seconds over 0"},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'pray' }",
       "on_fail: pray: allowed \"retract\", \"hold\" or \"stop\""},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1 }", "on_fail: missing"},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [17] = 0 } }",
       "hold[17]: 0: allowed theta 1 to 16"},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', untill = 1 }",
       "untill: 1: allowed no such field"},
      {"step 'a' { device = 'none', steer = {}, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "steer: given: allowed only with device"},
      {"step 'a' { device = 'vr', steer = { node = 9 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "steer.node: 9: allowed 0 (none) or a node 1 to 7"},
      {"step 'a' { device = 'vr', steer = { sclae = 1 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "steer.sclae: 1: allowed only scale, rotation_scale, node, speed_m_s"},
      {"step 'a' { device = 'vr', steer = { scale = 0 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "steer.scale: 0: allowed 0.01 to 100"},
      {"step 'a' { device = 'none', exit = liana.at_pose(nil), time_limit_s = 1, on_fail = 'hold' }",
       "given.lua:3: at_pose: name: nil: allowed a string"},
      {"step 'a' { device = 'none', exit = liana.all { at_rest }, time_limit_s = 1, on_fail = 'hold' }", "all: entry 1: function: "},
      {"step 'a' { device = 'none', exit = liana.tip_past 'x', time_limit_s = 1, on_fail = 'hold' }", "tip_past: u_m: x: allowed a number"},
      {"step 'a' { device = 'none', exit = liana.needs_planar(nil), time_limit_s = 1, on_fail = 'hold' }",
       "needs_planar: count: nil: allowed a number"},
      // What only the robot (zhu2022: 5 segments, 20 deg) forbids.
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [11] = 0 } }",
       "step 1 \"a\": hold[11]: 0: allowed theta 1 to 10 (robot zhu2022)"},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [9] = 45 } }",
       "hold[9]: 45: allowed -20 to 20 degrees (robot zhu2022)"},
      {"step 'a' { device = 'vr', steer = { node = 5 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "steer.node: 5: allowed 0 (none) to 4 (robot zhu2022)"},
      {"step 'a' { device = 'vr', steer = { speed_m_s = 0.5 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "steer.speed_m_s: 0.5: allowed up to 0.1 (robot zhu2022)"},
      {"step 'a' { device = 'none', run = liana.move_to 'nowhere', exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       "run: pose nowhere: allowed panel_edge, prepare"},
      {"step 'a' { device = 'none', exit = liana.any { at_rest(), liana.all { liana.at_pose 'x' } }, time_limit_s = 1, on_fail = 'hold' }",
       "exit: pose x: allowed panel_edge, prepare"},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }, finish = liana.move_to 'home'",
       "finish: pose home: allowed panel_edge, prepare"},
      {"finish = 3", "finish: 3: allowed an action"}};
  const TemporaryFolder folder;
  for (const BadMission& mission : missions) {
    const std::string file = folder.write(
        "given.lua", "local liana = require 'liana'\nlocal step, at_rest = liana.step, liana.at_rest\nreturn liana.mission 'm' { " +
                         std::string(mission.steps) + " }\n");
    const Ended ended = run_program("eval mission " + file);
    EXPECT_EQ(ended.code, 2) << mission.steps;
    EXPECT_NE(ended.error.find(mission.message), std::string::npos) << mission.steps << " -> " << ended.error;
    EXPECT_NE(ended.error.find("given.lua:"), std::string::npos) << ended.error;
  }
}

TEST(Eval, AMissionIsCheckedAgainstTheRobotThatIsNamed) {
  const TemporaryFolder folder;
  const std::string robot = folder.write("short.lua",
                                         "local t = require 'robots.zhu2022'\nt.name, t.named_poses_deg.panel_edge = 'short', nil\n"
                                         "return t\n");
  const Ended ended = run_program("eval mission slit_crossing --robot " + robot);
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.error.find("pose panel_edge: allowed prepare, press_rod, segment5_in_slit, zero (robot short)"), std::string::npos)
      << ended.error;
}

TEST(Eval, RefusesAMissionFileThatReturnsSomethingElse) {
  const TemporaryFolder folder;
  const Ended ended = run_program("eval mission " + folder.write("given.lua", "return {}"));
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.error.find("return the mission at the end of the file"), std::string::npos) << ended.error;
}

}  // namespace
}  // namespace liana
