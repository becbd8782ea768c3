#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <tuple>

#include "host/base/json/json.hpp"

#include "tests/lua/program.hpp"
#include "tests/message.hpp"

namespace liana::mission_runner {
namespace {

TEST(Eval, PrintsTheSameCanonicalTextTwice) {
  for (const std::string table : {"robot zhu2022", "scene panel_slit", "buses embedded", "buses embedded_500",
                                  "buses embedded_single", "buses vcan", "robot micro", "buses embedded_micro"}) {
    const Ended first = run_program("eval " + table);
    EXPECT_EQ(first.code, 0) << first.error;
    EXPECT_EQ(first.error, "");
    EXPECT_EQ(first.out, run_program("eval " + table).out);
    EXPECT_EQ(first.out.find(' '), std::string::npos) << table;
  }
}

TEST(Eval, ABusTableBringsTheDriveTypesThatItNames) {
  const TemporaryFolder folder;
  const std::string file = folder.write("given.lua",
                                        "local t = require 'buses.embedded'\n"
                                        "t.drives = { { type = 'cia402_csp', nodes = { 3, 9 } } }\nreturn t\n");
  const Ended ended = run_program("eval buses " + file);
  ASSERT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(Json::parse(ended.out)["drive_types"]["cia402_csp"]["name"], "cia402_csp");
}

struct Change {
  const char* kind;
  const char* module;
  const char* statement;  // applied to table t
  Facts facts;            // that the message names
};

// Lua tables of users, each with one mistake: the message names file, field, value, what is allowed and what to do.
TEST(Eval, RefusesMalformedLuaTablesByField) {
  const std::vector<Change> changes = {
      {"robot", "robots.zhu2022", "t.segments[2].modules = 99", {"given.lua", "segments[1].modules", "99", "1", "16"}},
      {"robot",
       "robots.zhu2022",
       "t.module.mass_kg = 'heavy'",
       {"given.lua", "module.mass_kg", "heavy", "1e-06", "100", "number"}},
      {"robot", "robots.zhu2022", "t.format = 3", {"given.lua", "format", "3", "1"}},
      {"robot", "robots.zhu2022", "t.limits.tip_speed = 1", {"given.lua", "limits.tip_speed", "1", "field"}},
      {"robot",
       "robots.zhu2022",
       "t.limits.tip_sped_m_s, t.limits.tip_speed_m_s = t.limits.tip_speed_m_s, nil",
       {"given.lua", "limits.tip_sped_m_s", "0.1", "field"}},
      {"robot",
       "robots.zhu2022",
       "t.drives.idenity, t.drives.identity = t.drives.identity, nil",
       {"given.lua", "drives.idenity"}},
      {"robot", "robots.zhu2022", "t.drives = nil", {"given.lua", "drives", "missing"}},
      {"robot",
       "robots.zhu2022",
       "for i = 6, 9 do t.segments[i] = t.segments[1] end",
       {"given.lua", "segments", "9", "1", "8", "list"}},
      {"scene",
       "scenes.panel_slit",
       "t.spheres[1].radius_m = -1",
       {"given.lua", "spheres[1].radius_m", "-1", "1e-04", "100"}},
      {"scene", "scenes.panel_slit", "t.boxes[1].rotation[1] = {1,1,1}", {"given.lua", "boxes[1].rotation"}},
      {"scene", "scenes.panel_slit", "t.rod.position_m = {1,2}", {"given.lua", "rod.position_m", "2", "3", "list"}},
      {"scene", "scenes.panel_slit", "t.slit.offset_m = t.slit.offset_m + 0.1", {"given.lua", "slit.frame.position_m"}},
      {"buses", "buses.embedded", "t.rate_hz = 300", {"given.lua", "rate_hz", "300", "period"}},
      {"buses", "buses.embedded", "t.buses[1].nodes[1] = 0", {"given.lua", "buses[1].nodes[1]", "0", "1", "126"}},
      {"buses", "buses.embedded", "t.buses[2].nodes[1] = 1", {"given.lua", "buses[2].nodes[1]", "1"}},
      {"buses", "buses.embedded_single", "t.rate_hz = 250", {"given.lua", "buses[1].nodes"}},
      {"buses",
       "buses.embedded",
       "t.backend = 'ethernet'",
       {"given.lua", "backend", "ethernet", "embedded", "socketcan"}},
      {"buses", "buses.embedded", "t.kind = 'robot'", {"given.lua", "kind", "robot", "buses"}},
      {"buses",
       "buses.embedded",
       "t.drives = { { type = 'nobodys', nodes = { 1 } } }",
       {"given.lua", "drive", "nobodys", "cia402_csp"}},
      {"buses",
       "buses.embedded",
       "t.drives = { { typ = 'cia402_csp', nodes = { 1 } } }",
       {"given.lua", "drives[1].type", "missing"}},
      {"drive", "drives.cia402_csp", "t.polarity = 3", {"given.lua", "polarity", "3", "0", "64", "128", "192"}}};
  const TemporaryFolder folder;
  for (const Change& change : changes) {
    const std::string file = folder.write(
        "given.lua", "local t = require '" + std::string(change.module) + "'\n" + change.statement + "\nreturn t\n");
    const Ended ended = run_program("eval " + std::string(change.kind) + " " + file);
    EXPECT_EQ(ended.code, 2) << change.statement;
    EXPECT_TRUE(names(ended.error, change.facts)) << change.statement;
    EXPECT_EQ(std::count(ended.error.begin(), ended.error.end(), '\n'), 1) << ended.error;
  }
}

// A scene whose one convex body comes from a file beside it.
std::string scene_with(const std::string& fields) {
  return "return { format = 1, kind = 'scene', name = 'own', boxes = {}, spheres = {}, convex = { { name = 'part', " +
         fields + " } } }\n";
}

// A wedge of two triangles and a point inside their hull, 100 units high.
constexpr const char* kWedge = R"(solid wedge
 facet normal 0 0 0 outer loop vertex 0 0 0 vertex 100 0 0 vertex 0 100 0 endloop endfacet
 facet normal 0 0 0 outer loop vertex 0 0 100 vertex 10 10 10 vertex 100 0 0 endloop endfacet
endsolid wedge
)";

TEST(Eval, PutsTheHullOfAnStlFileIntoTheScene) {
  const TemporaryFolder folder;
  folder.write("wedge.stl", kWedge);
  const std::string file =
      folder.write("given.lua", scene_with("stl = 'wedge.stl', unit_m = 0.001, position_m = { 1, 0, 0 }, "
                                           "quaternion_wxyz = { 0, 0, 0, 1 }"));  // half a turn about z
  const Ended ended = run_program("eval scene " + file);
  ASSERT_EQ(ended.code, 0) << ended.error;
  const Json body = Json::parse(ended.out)["convex"][0];
  EXPECT_FALSE(body.contains("stl"));
  std::vector<std::array<double, 3>> points = body["points_m"].get<std::vector<std::array<double, 3>>>();
  std::sort(points.begin(), points.end());
  ASSERT_EQ(points.size(), 4u) << "the point inside is left out";
  EXPECT_NEAR(points[0][0], 0.9, 1e-12);
  EXPECT_NEAR(points[3][0], 1.0, 1e-12);
}

TEST(Eval, RefusesWhatIsNoShapeFile) {
  struct Bad {
    const char* fields;
    Facts facts;
  };
  const std::vector<Bad> cases = {
      {"stl = 'none.stl'", {"given.lua", "none.stl"}},
      {"stl = 'text.stl'", {"given.lua", "text.stl", "no STL"}},
      {"stl = 'short.stl'", {"given.lua", "short.stl", "numbers"}},
      {"stl = '../wedge.stl'", {"given.lua", "convex[1].stl"}},
      {"stl = 'wedge.stl', unit_m = 0", {"given.lua", "convex[1].unit_m", "0"}},
      {"stl = 'wedge.stl', points_m = {}", {"given.lua", "convex[1].points_m"}},
      {"stl = 'wedge.stl', quaternion_wxyz = { 1, 1, 0, 0 }", {"given.lua", "convex[1].quaternion_wxyz"}},
      {"stl = 'flat.stl'", {"given.lua", "convex[1].points_m"}}};
  const TemporaryFolder folder;
  folder.write("wedge.stl", kWedge);
  folder.write("text.stl", "no shape at all");
  folder.write("short.stl", "solid vertex 1 2");
  folder.write("flat.stl", "solid vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 vertex 1 1 0");
  for (const Bad& bad : cases) {
    const Ended ended = run_program("eval scene " + folder.write("given.lua", scene_with(bad.fields)));
    EXPECT_EQ(ended.code, 2) << bad.fields;
    EXPECT_TRUE(names(ended.error, bad.facts)) << bad.fields;
  }
}

TEST(Eval, NamesWhatThereIsWhenANameIsUnknown) {
  const Ended ended = run_program("eval buses can9");
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(names(ended.error,
                    {"can9", "embedded", "embedded_500", "embedded_feeder", "embedded_lab_1g", "embedded_macro_micro",
                     "embedded_macro_micro_stiff", "embedded_micro", "embedded_micro_single", "embedded_payload",
                     "embedded_single", "embedded_three_segment_lab", "embedded_two_axes", "vcan"}));
}

// req:A50 req:A52
TEST(Eval, DescribesTheSlitCrossing) {
  const Ended ended = run_program("eval mission slit_crossing");
  ASSERT_EQ(ended.code, 0) << ended.error;
  const auto mission = Json::parse(ended.out);
  ASSERT_EQ(mission["steps"].size(), 6u);
  EXPECT_EQ(mission["steps"][1]["device"], "vr");
  EXPECT_EQ(mission["steps"][4]["held_theta"], Json({7, 9}));  // X5 first, then X4
  EXPECT_EQ(mission["steps"][3]["held_theta"], Json({9}));
}

// What only the scene can tell, and what may not be meant, goes to who starts the mission.
TEST(Eval, DescribesWhatConditionsLookAtAndNamesThatTwoStepsHave) {
  const TemporaryFolder folder;
  const std::string rest = " device = 'none', time_limit_s = 1, on_fail = 'hold', exit = liana.";
  const Ended ended = run_program(
      "eval mission " +
      folder.write("given.lua", "local liana = require 'liana'\nreturn liana.mission 'm' {\nliana.step 'a' {" + rest +
                                    "all { liana.at_rest(), liana.tip_near_rod(0.1) } },\nliana.step 'a' {" + rest +
                                    "tip_past(1) },\nliana.step 'finish' {" + rest + "at_rest() } }\n"));
  ASSERT_EQ(ended.code, 0) << ended.error;
  const auto mission = Json::parse(ended.out);
  EXPECT_EQ(mission["steps"][0]["parts"][0]["part"], "rod");
  EXPECT_EQ(mission["steps"][1]["parts"][0]["part"], "slit");
  EXPECT_EQ(mission["steps"][1]["parts"][0]["field"], "exit");
  EXPECT_EQ(mission["steps"][2]["parts"].size(), 0u);
  ASSERT_EQ(mission["notes"].size(), 2u);
  EXPECT_TRUE(names(mission["notes"][0].text(), {"step 2", "a", "step 1"}));
  EXPECT_TRUE(names(mission["notes"][1].text(), {"step 3", "finish", "next"}));
}

struct BadMission {
  const char* steps;
  Facts facts;
};

TEST(Eval, RefusesMalformedMissionsByStepAndField) {
  const std::vector<BadMission> missions = {
      {"", {"given.lua", "mission m", "steps", "none"}},
      {"step 'a' { device = 'joy stick', exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "step 1", "a", "device", "joy stick", "vr"}},
      {"step 'a' { device = 'none', exit = at_rest, time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "step 1", "a", "exit", "function", "condition"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 0, on_fail = 'hold' }",
       {"given.lua", "time_limit_s", "0"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 0/0, on_fail = 'hold' }",
       {"given.lua", "time_limit_s", "nan", "0"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'pray' }",
       {"given.lua", "on_fail", "pray", "retract", "hold", "stop", "pause"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1 }", {"given.lua", "on_fail", "missing"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [17] = 0 } }",
       {"given.lua", "hold[17]", "entry 1", "held", "theta", "17", "1", "10"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', untill = 1 }",
       {"given.lua", "untill", "1", "field"}},
      {"step 'a' { device = 'vr', steer = {}, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "steer", "teleoperate"}},
      {"step 'a' { device = 'none', teleoperate = {}, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "teleoperate", "given", "device"}},
      {"step 'a' { device = 'vr', teleoperate = { node = 9 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "teleoperate", "node", "9", "0", "4", "zhu2022"}},
      {"step 'a' { device = 'vr', teleoperate = { sclae = 1 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "teleoperate", "sclae", "1", "device", "scale", "rotation_scale", "node", "speed_m_s", "unknown"}},
      {"step 'a' { device = 'vr', teleoperate = { device = 'hand' }, exit = at_rest(), time_limit_s = 1, on_fail = "
       "'hold' }",
       {"given.lua", "teleoperate.device", "hand", "nothing"}},
      {"step 'a' { device = 'vr', teleoperate = { fixtures = {} }, exit = at_rest(), time_limit_s = 1, on_fail = "
       "'hold' }",
       {"given.lua", "teleoperate.fixtures", "table", "nothing"}},
      {"step 'a' { device = 'none', fixtures = false, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "fixtures", "given", "device"}},
      {"step 'a' { device = 'hand', fixtures = { 1 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "fixtures", "table", "true", "false"}},
      {"step 'a' { device = 'hand', feedback = 'loud', exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "feedback", "loud", "aligned", "claim", "abstract", "off"}},
      {"step 'a' { device = 'none', feedback = 'off', exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "feedback", "given", "device"}},
      {"step 'a' { device = 'vr', teleoperate = { scale = 0 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "teleoperate", "scale", "0", "0.01", "100"}},
      {"step 'a' { device = 'none', exit = liana.at_pose(nil), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua:3", "at_pose", "name", "nil", "string"}},
      {"step 'a' { device = 'none', exit = liana.all { at_rest }, time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "all", "1", "function"}},
      {"step 'a' { device = 'none', exit = liana.tip_past 'x', time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "tip_past", "u_m", "x", "number"}},
      {"step 'a' { device = 'none', exit = liana.tip_force(0), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "tip_force", "least_N", "0", "number"}},
      {"step 'a' { device = 'none', exit = liana.tip_force(1, 1), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "tip_force", "sd_N", "1", "0"}},
      {"step 'a' { device = 'none', exit = liana.needs_planar(nil), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "needs_planar", "count", "nil", "number"}},
      // What only the robot (zhu2022: 5 segments, 20 deg) forbids.
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [11] = 0 } }",
       {"given.lua", "step 1", "a", "hold[11]", "entry 1", "held", "theta", "11", "1", "10", "zhu2022"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [9] = 45 } }",
       {"given.lua", "hold[9]", "entry 1", "held", "target_deg", "45", "-20", "20", "zhu2022"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [1] = 0, [3] = 0, "
       "[5] = 0, [7] = 0, [9] = 0 } }",
       {"given.lua", "step 1", "a", "hold", "5", "4", "zhu2022", "10", "6"}},
      {"step 'a' { device = 'vr', teleoperate = { node = 5 }, exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "teleoperate", "node", "5", "0", "4", "zhu2022"}},
      {"step 'a' { device = 'vr', teleoperate = { speed_m_s = 0.5 }, exit = at_rest(), time_limit_s = 1, on_fail = "
       "'hold' }",
       {"given.lua", "teleoperate", "speed_m_s", "0.5", "1e-04", "0.1", "zhu2022"}},
      {"step 'a' { device = 'none', run = liana.move_to 'nowhere', exit = at_rest(), time_limit_s = 1, on_fail = "
       "'hold' }",
       {"given.lua", "run", "nowhere", "jig", "panel_edge", "prepare"}},
      {"step 'a' { device = 'none', exit = liana.any { at_rest(), liana.all { liana.at_pose 'x' } }, time_limit_s = 1, "
       "on_fail = 'hold' }",
       {"given.lua", "exit", "x", "jig", "panel_edge", "prepare"}},
      {"step 'a' { device = 'none', exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }, finish = liana.move_to "
       "'home'",
       {"given.lua", "finish", "home", "jig", "panel_edge", "prepare"}},
      {"step 'a' { device = 'none', run = liana.shape { { node = 3, position_m = { 1, 0, 0 } }, { node = 5, position_m "
       "= { 1, 0, 0 } } }, "
       "exit = at_rest(), time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "step 1", "a", "run", "shape", "entry 2", "nodes", "node", "5", "1", "4"}},
      {"step 'a' { device = 'none', run = liana.shape { { node = 3, position_m = { 9, 0, 0 } } }, exit = at_rest(), "
       "time_limit_s = 1, "
       "on_fail = 'hold' }",
       {"given.lua", "entry 1", "nodes", "position_m[1]", "9", "-4", "4"}},
      {"step 'a' { device = 'none', run = liana.shape { { node = 3, position_m = { 1, 0, 0 }, wieght = 2 } }, exit = "
       "at_rest(), "
       "time_limit_s = 1, on_fail = 'hold' }",
       {"given.lua", "entry 1", "nodes", "wieght", "2", "node", "position_m", "weight", "threshold_m", "unknown"}},
      {"step 'a' { device = 'none', run = liana.shape({}, { { center_m = { 1, 0, 0 } } }), exit = at_rest(), "
       "time_limit_s = 1, "
       "on_fail = 'hold' }",
       {"given.lua", "entry 1", "keep_clear", "distance_m", "number"}},
      {"step 'a' { device = 'none', run = liana.move_to('prepare', 3), exit = at_rest(), time_limit_s = 1, on_fail = "
       "'hold' }",
       {"given.lua", "run", "move_to", "rate_deg_s", "3", "0.01", "2"}},
      {"finish = 3", {"given.lua", "finish", "3", "action"}}};
  const TemporaryFolder folder;
  for (const BadMission& mission : missions) {
    const std::string file = folder.write(
        "given.lua",
        "local liana = require 'liana'\nlocal step, at_rest = liana.step, liana.at_rest\nreturn liana.mission 'm' { " +
            std::string(mission.steps) + " }\n");
    const Ended ended = run_program("eval mission " + file);
    EXPECT_EQ(ended.code, 2) << mission.steps;
    EXPECT_TRUE(names(ended.error, mission.facts)) << mission.steps;
  }
}

// A script of several lines: the line is that of the step, or of the condition or action in it.
TEST(Eval, RefusalsOfAStepNameItsOwnLine) {
  const TemporaryFolder folder;
  const std::string head = "local liana = require 'liana'\n\nreturn liana.mission 'm' {\n", tail = " },\n}\n";
  const std::string good =
      "  liana.step 'a' { device = 'none', exit = liana.at_rest(),\n   time_limit_s = 1, on_fail = 'hold'";
  const auto eval = [&](const std::string& more) {
    return run_program("eval mission " + folder.write("given.lua", head + good + " },\n" + good + more + tail)).error;
  };
  EXPECT_EQ(eval(""), "");
  for (const auto& [fields, line, facts] : std::vector<std::tuple<std::string, std::string, Facts>>{
           {", time = 1", "given.lua:6", {"mission m", "step 2", "a", "time"}},
           {", hold = { [99] = 0 }", "given.lua:6", {"mission m", "step 2", "a", "hold[99]"}},
           {",\n fail_when = liana.at_pose 'x'", "given.lua:8", {"mission m", "step 2", "a", "fail_when", "x"}},
           {",\n\n run = liana.move_to('prepare', 9)", "given.lua:9", {"step 2", "a", "run", "move_to", "rate_deg_s"}},
           {", fail_when = 3", "given.lua:6", {"step 2", "a", "fail_when", "3", "condition"}},
           {", fail_when = { met = function() end }",
            "given.lua:6",
            {"step 2", "a", "fail_when", "table", "condition"}},
           {", enter = liana.any {}", "given.lua:7", {"any", "list", "empty", "condition"}},
           {", enter = liana.at_pose('prepare', -1)", "given.lua:7", {"at_pose", "tolerance_deg", "-1", "number"}}}) {
    EXPECT_TRUE(names(eval(fields), {"liana-mission", folder.file(line)})) << fields;
    EXPECT_TRUE(names(eval(fields), facts)) << fields;
  }
}

TEST(Eval, RefusesWaysThatLeadNowhereOrForEverByStepAndLine) {
  const TemporaryFolder folder;
  const auto eval = [&](const std::string& a, const std::string& b, const std::string& c) {
    const std::string rest = " device = 'none', exit = liana.at_rest(), time_limit_s = 1, on_fail = 'hold', ";
    return run_program(
               "eval mission " +
               folder.write("given.lua", "local liana = require 'liana'\nreturn liana.mission 'm' {\nliana.step 'a' {" +
                                             rest + a + " },\nliana.step 'b' {" + rest + b + " },\nliana.step 'c' {" +
                                             rest + c + " } }\n"))
        .error;
  };
  EXPECT_EQ(eval("next = 'c'", "next = 'finish'", "next = { step = 'b', at_most = 3 }"), "");
  struct Bad {
    std::string a, b, c;
    Facts facts;
  };
  for (const Bad& bad : std::vector<Bad>{
           {"", "next = 'd'", "", {"given.lua:4", "mission m", "step 2", "b", "next", "d", "a", "c", "finish"}},
           {"",
            "next = 'a'",
            "}, liana.step 'a' { device = 'none', exit = liana.at_rest(), time_limit_s = 1, on_fail = 'hold'",
            {"given.lua", "next", "step", "a", "steps 1 and 4"}},
           {"",
            "next = 'a'",
            "",
            {"given.lua:4", "mission m", "step 2", "b", "next", "at_most", "missing", "1", "1000"}},
           {"", "next = { { step = 'b' } }", "", {"given.lua:4", "step 2", "b", "next[1]", "at_most", "missing"}},
           {"next = 'c'", "", "", {"given.lua:4", "step 2", "b", "never"}},
           {"", "next = { step = 'a', at_most = 0 }", "", {"given.lua", "next", "at_most", "0", "whole"}},
           {"", "next = { step = 'a', at_most = 1.5 }", "", {"given.lua", "next", "at_most", "1.5", "whole"}},
           {"",
            "next = { step = 'a', times = 2 }",
            "",
            {"given.lua", "next", "times", "2", "step", "when", "on", "at_most"}},
           {"", "next = { stp = 'a' }", "", {"given.lua", "next", "table", "step", "name"}},
           {"", "next = function() return 'a' end", "", {"given.lua", "next", "function", "name"}},
           {"", "next = 3", "", {"given.lua", "next", "3", "name"}},
           {"", "next = { 'c' }", "", {"given.lua", "next[1]", "c", "step", "name"}},
           {"", "next = { step = 'c', when = true }", "", {"given.lua", "next", "when", "true", "condition"}},
           {"", "next = { step = 'c', on = 'fault' }", "", {"given.lua", "next", "on", "fault", "success", "failure"}},
           {"", "next = { { step = 'c' }, { step = 'a', at_most = 1 } }", "", {"given.lua", "next[2]", "never"}},
           {"", "next = { step = 'c', when = liana.at_pose 'x' }", "", {"given.lua", "next", "x", "jig"}},
           {"hold = { [9] = 0 }, next = { step = 'c', when = liana.at_rest() }",
            "hold = {}",
            "",
            {"given.lua:5", "mission m", "step 3", "c", "hold", "missing", "a", "{ [9] = 0 }", "b", "{}"}},
           {"",
            "hold = { [9] = 0 }, next = { step = 'a', at_most = 1 }",
            "",
            {"given.lua:3", "mission m", "step 1", "a", "hold", "missing", "start", "{}", "b", "{ [9] = 0 }"}}}) {
    EXPECT_TRUE(names(eval(bad.a, bad.b, bad.c), bad.facts)) << bad.a << bad.b << bad.c;
  }
}

// What is written as a value, or asked for by a function before it looks at the arm, is known before the start.
TEST(Eval, AGoalThatIsKnownIsLookedAtBeforeTheStartAndAComputedOneInItsTime) {
  const TemporaryFolder folder;
  const auto eval = [&](const std::string& run) {
    return run_program(
        "eval mission " +
        folder.write("given.lua",
                     "local liana = require 'liana'\nreturn liana.mission 'm' {\nliana.step 'a' { device = "
                     "'none', exit = liana.at_rest(), time_limit_s = 1, on_fail = 'hold', hold = { [9] = 3 "
                     "},\nrun = " +
                         run + " } }\n"));
  };
  const std::string far = "{ 9, 0, 0, 1, 0, 0, 0 }";
  for (const std::string& run :
       {"liana.move_cp { goal = " + far + " }", "function(arm) arm.move_cp { goal = " + far + " } end",
        "function(arm) local pose = arm.named_pose 'zero' arm.shape {} arm.move_cp { goal = " + far + " } end"}) {
    const Ended ended = eval(run);
    EXPECT_EQ(ended.code, 2) << run;
    EXPECT_TRUE(names(ended.error, {"given.lua:4", "mission m", "step 1", "a", "run", "move_cp", "goal[1]", "9"}))
        << run;
  }
  for (const auto& [run, facts] : std::vector<std::pair<std::string, Facts>>{
           {"liana.move_jp { goal_deg = { 0, 0, 99, 0, 0, 0, 0, 0, 0, 0 } }", {"goal_deg[3]", "theta 3", "99"}},
           {"liana.move_jp { goal_deg = { 0, 0/0 } }", {"goal_deg[2]", "nan", "finite"}},
           {"liana.move_cp { goal = { 3, 0, 0, 1, 0, 0 } }", {"goal", "6", "array", "7"}},
           {"liana.move_cp { goal = { 3, 0, 0, 0.5, 0, 0, 0 } }", {"quaternion", "qw,qx,qy,qz"}},
           {"liana.move_cp { goal = { 3, 0, 0, 1, 0, 0, 0 }, hold = { { theta = 11, target_deg = 0 } } }",
            {"hold", "theta", "11"}},
           {"liana.move_cp { goal = { 3, 0, 0, 1, 0, 0, 0 }, hold = { { theta = 1, target_deg = 0 }, { theta = 1, "
            "target_deg "
            "= 2 } } }",
            {"run", "move_cp", "hold", "theta 1", "twice"}},
           {"function(arm) arm.move_cp { goal = { 3, 0, 0, 1, 0, 0, 0 }, hold = { { theta = 1, target_deg = 0 }, { "
            "theta = "
            "2, target_deg = 0 }, { theta = 3, target_deg = 0 }, { theta = 4, target_deg = 0 }, { theta = 5, "
            "target_deg = "
            "0 } } } end",
            {"run", "move_cp", "hold", "5 angles", "4"}},
           {"liana.move_cp(3)", {"move_cp", "fields", "3", "table"}}}) {
    EXPECT_TRUE(names(eval(run).error, facts)) << run;
  }
  for (const std::string& run :
       {"function(arm) if arm.state.tick > 3 then arm.move_cp { goal = " + far + " } end end",
        std::string("function(arm) arm.move_cp { goal = later } end"),
        std::string("function(arm) arm.move_jp { goal_deg = arm.named_pose 'nowhere' } end"),
        std::string("function(arm) while true do end end"), std::string("function() error 'no' end")}) {
    const Ended ended = eval(run);
    EXPECT_EQ(ended.code, 0) << run << ": " << ended.error;
    EXPECT_FALSE(Json::parse(ended.out)["steps"][0].contains("goal_tip")) << run;
  }
  const Json step = Json::parse(eval("liana.move_cp { goal = { 3, 0, 0, 1, 0, 0, 0 } }").out)["steps"][0];
  EXPECT_EQ(step["goal_tip"], Json::parse("[3,0,0,1,0,0,0]"));
  EXPECT_EQ(step["goal_hold"], Json::parse(R"([{"theta":9,"target_deg":3}])"));
  EXPECT_TRUE(step["goal_at"].text().ends_with("given.lua:4: ")) << step["goal_at"].text();
}

TEST(Eval, RequireFindsWhatLiesBesideTheMissionAndNothingElse) {
  const TemporaryFolder folder, elsewhere;
  std::filesystem::create_directory(folder.file("parts"));
  folder.write("Helpers.lua", "return 'prepare'\n");
  folder.write("parts/pose-2.lua", "return require 'Helpers'\n");
  folder.write("liana.lua", "error 'not this one'\n");
  folder.write("fails.lua", "local x = nil + 1\n");
  folder.write("silent.lua", "local x = 1\n");
  folder.write("circle.lua", "return require 'circle'\n");
  elsewhere.write("secret.lua", "return 'prepare'\n");
  std::filesystem::create_symlink(elsewhere.file("secret.lua"), folder.file("linked.lua"));
  const auto eval = [&](const std::string& required) {
    return run_program(
        "eval mission " +
        folder.write("given.lua", "local liana = require 'liana'\nlocal pose = " + required +
                                      "\nreturn liana.mission 'm' { liana.step 'a' { device = 'none', run = "
                                      "liana.move_to(pose), exit = liana.at_rest(), time_limit_s = 1, on_fail = "
                                      "'hold' } }\n"));
  };
  const Ended good = eval("require 'parts.pose-2'");
  ASSERT_EQ(good.code, 0) << good.error;
  const Json files = Json::parse(good.out)["files"];
  ASSERT_EQ(files.size(), 3u) << "what the run is made of: " << files;
  EXPECT_EQ(files[0]["file"], "given.lua");
  EXPECT_EQ(files[1]["file"], "parts/pose-2.lua");
  EXPECT_EQ(files[2]["sha256"].text().size(), 64u);
  const std::string home = std::filesystem::canonical(folder.file(".")).string();
  for (const auto& [required, facts] : std::vector<std::pair<std::string, Facts>>{
           {"require 'nothing'", {"given.lua:2", "require", "nothing.lua", home, LIANA_SOURCE_DIR "/lua"}},
           {"require 'linked'", {"require", "linked.lua", "out of", home}},
           {"require '../secret'", {"require", "../secret", "modules"}},
           {"require '/etc/passwd'", {"require", "/etc/passwd", "modules"}},
           {"require 'fails'", {"fails.lua:1", "arithmetic"}},
           {"require 'silent'", {"require", "silent", "nothing"}},
           {"require 'circle'", {"modules", "circle"}},
           {"select(2, pcall(require, 'fails')) and require 'fails'", {"fails.lua:1", "arithmetic"}}}) {
    const Ended ended = eval(required);
    EXPECT_EQ(ended.code, 2);
    EXPECT_TRUE(names(ended.error, facts)) << required;
  }
}

TEST(Eval, APlanAsAStepIsCheckedAgainstItsRobotAndTheStepsBefore) {
  const TemporaryFolder folder;
  const std::string robot = run_program("eval robot zhu2022").out, zero = "[0,0,0,0,0,0,0,0,0,0]";
  const auto plan = [&](const std::string& first, const std::string& of) {
    folder.write("way.json", R"({"outcome":"solved","waypoints_deg":[)" + first + "," + zero +
                                 R"(],"inputs":{"robot":)" + of + "}}");
  };
  const auto eval = [&](const std::string& fields, const std::string& before = "run = liana.move_to 'zero'") {
    return run_program(
        "eval mission " +
        folder.write(
            "given.lua",
            "local liana = require 'liana'\nlocal t = { device = 'none', time_limit_s = 1, on_fail = 'hold' }\n"
            "local function step(name, f) for k, v in pairs(t) do f[k] = f[k] or v end return liana.step(name)(f) end\n"
            "return liana.mission 'm' { step('a', { exit = liana.at_rest(), " +
                before + " }), step('b', { " + fields + " }) }\n"));
  };
  plan("[0,0,0,0,0,0,0,0,0,0.5]", robot);
  const Ended good = eval("plan = 'way.json'");
  ASSERT_EQ(good.code, 0) << good.error;
  const Json step = Json::parse(good.out)["steps"][1];
  EXPECT_TRUE(names(step["enter"].text(), {"1 deg", "plan's start"}));
  EXPECT_EQ(step["goal_deg"], Json::parse(zero));
  const auto refused = [&](const std::string& fields, const Facts& facts,
                           const std::string& before = "run = liana.move_to 'zero'") {
    const Ended ended = eval(fields, before);
    EXPECT_EQ(ended.code, 2);
    EXPECT_TRUE(names(ended.error, facts)) << fields;
  };
  refused("plan = 'way.json'", {"step 2", "b", "plan", "theta 1", "0 deg", "1 deg", "-8.5", "step 1", "a"},
          "run = liana.move_to 'prepare'");
  refused("plan = 'way.json', exit = liana.at_rest()", {"step 2", "b", "exit", "plan"});
  refused("plan = 'way.json', device = 'vr'", {"step 2", "b", "device", "vr", "none", "plan"});
  refused("plan = 'way.json'", {"step 2", "b", "hold", "{}", "plan"}, "hold = { [9] = 0 }");
  refused("plan = 'none.json'", {"plan", "none.json", "no such file"});
  refused("plan = '../way.json'", {"plan", "../way.json", "out of"});
  refused("plan = '/etc/passwd'", {"plan", "/etc/passwd", "out of"});
  plan(zero, run_program("eval robot three_segment_lab").out);
  refused("plan = 'way.json'", {"inputs.robot", "three_segment_lab", "zhu2022"});
  folder.write("way.json", R"({"points_m":[[0,0,0],[1,0,0]]})");
  refused("plan = 'way.json'", {"curve", "solved", "liana plan --follow=CURVE"});
  folder.write("way.json", "{");
  refused("plan = 'way.json'", {"step 2", "b", "plan", "way.json"});
}

// What is said of a mission of one step, which has these fields besides those that every step has.
std::string error_of_step(const TemporaryFolder& folder, const std::string& options, const std::string& fields) {
  const std::string mission =
      folder.write("given.lua",
                   "local liana = require 'liana'\nreturn liana.mission 'm' { liana.step 'a' {\n"
                   "exit = liana.at_rest(), time_limit_s = 1, on_fail = 'hold', " +
                       fields + " } }\n");
  return run_program("eval mission " + options + mission).error;
}

TEST(Eval, ATaskIsARecordingBesideTheMissionOrIsRefused) {
  const TemporaryFolder folder;
  const auto eval = [&](const std::string& fields) { return error_of_step(folder, "", fields); };
  EXPECT_EQ(eval("device = 'vr', task = 'panel_edge_vr'"), "") << "one of Liana's own";
  EXPECT_EQ(eval("device = 'hand', task = 'rod'"), "");
  const std::string missing = eval("device = 'vr', task = 'my_hand'");
  EXPECT_TRUE(names(missing, {"given.lua:2", "mission m", "step 1", "a", "task", "my_hand", "my_hand.hand",
                              folder.file("").substr(0, folder.file("").size() - 1)}));
  folder.write("my_hand.hand", "liana-hand 1 hand\n");
  EXPECT_TRUE(names(eval("device = 'vr', task = 'my_hand'"), {"task", "my_hand", "VR"}));
  folder.write("my_hand.hand", "liana-hand 1 vr\n");
  EXPECT_EQ(eval("device = 'vr', task = 'my_hand'"), "");
  EXPECT_TRUE(names(eval("device = 'vr', task = '../my_hand'"), {"task", "../my_hand", "name"}));
  EXPECT_TRUE(names(eval("device = 'hand', task = 'my_hand'"), {"task", "my_hand", "slit", "rod"}));
  EXPECT_TRUE(names(eval("device = 'none', task = 'rod'"), {"task", "rod", "device"}));
}

TEST(Eval, APlanIsAMissionOfOneStepThatNamesIt) {
  const TemporaryFolder folder;
  const std::string zero = "[0,0,0,0,0,0,0,0,0,0]";
  const std::string robot = run_program("eval robot zhu2022").out;
  const auto plan = [&](const std::string& outcome, const std::string& waypoints, const std::string& of) {
    return "eval mission " +
           folder.write("plan.json", R"({"hash":"0123456789abcdef","outcome":")" + outcome + R"(","waypoints_deg":[)" +
                                         waypoints + R"(],"inputs":{"robot":)" + of + "}}");
  };
  const Ended good = run_program(plan("solved", zero + ",[1,0,0,0,0,0,0,0,0,0]", robot));
  ASSERT_EQ(good.code, 0) << good.error;
  const auto mission = Json::parse(good.out);
  ASSERT_EQ(mission["steps"].size(), 1u);
  EXPECT_EQ(mission["steps"][0]["name"], "plan, 2 waypoints");
  EXPECT_TRUE(names(mission["steps"][0]["enter"].text(), {"1 deg", "plan's start"}));
  const Ended unsolved = run_program(plan("limit", zero + "," + zero, robot));
  EXPECT_EQ(unsolved.code, 2);
  EXPECT_TRUE(names(unsolved.error, {"plan", "outcome", "limit", "solved"}));
  EXPECT_TRUE(names(run_program(plan("solved", zero, robot)).error, {"waypoints_deg", "1", "2"}));
  EXPECT_TRUE(names(run_program(plan("solved", zero + ",[1]", robot)).error, {"points_deg", "entry 2", "1", "10"}));
  EXPECT_TRUE(names(run_program(plan("solved", zero + "," + zero, "{}")).error, {"inputs.robot", "zhu2022", "tables"}));
}

TEST(Eval, AMissionIsCheckedAgainstTheRobotThatIsNamed) {
  const TemporaryFolder folder;
  const std::string robot =
      folder.write("short.lua",
                   "local t = require 'robots.zhu2022'\nt.name, t.named_poses_deg.panel_edge = 'short', nil\n"
                   "return t\n");
  const Ended ended = run_program("eval mission slit_crossing --robot " + robot);
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(names(ended.error, {"panel_edge", "jig", "prepare", "press_rod", "segment5_in_slit", "zero", "short"}));
}

// req:B1
TEST(Eval, AMissionSaysTheTablesThatItRunsWithAndIsCheckedAgainstItsOwnRobot) {
  const TemporaryFolder folder;
  const auto mission = [&](const std::string& fields) {
    return folder.write("given.lua", "local liana = require 'liana'\nreturn liana.mission 'm' { " + fields +
                                         "liana.step 'a' { device = 'none', run = liana.move_to 'install', exit = "
                                         "liana.at_rest(), time_limit_s = 1, on_fail = 'hold' } }\n");
  };
  const std::string own = mission("robot = 'macro_micro', scene = 'none', bus = 'embedded_payload', ");
  EXPECT_EQ(run_program("eval mission " + own).code, 0);
  EXPECT_EQ(run_program("eval mission " + own + " --robot zhu2022").code, 2);
  const Json said = Json::parse(run_program("eval mission_tables " + own).out);
  EXPECT_EQ(said["robot"], "macro_micro");
  EXPECT_EQ(said["scene"], "none");
  EXPECT_EQ(said["bus"], "embedded_payload");
  EXPECT_FALSE(Json::parse(run_program("eval mission_tables slit_crossing").out).contains("robot"));
  for (const auto& [fields, facts] : std::vector<std::pair<std::string, Facts>>{
           {"robot = 'no/file', ", {"mission m", "robot", "no/file", "table"}},
           {"scene = 1, ", {"mission m", "scene", "1", "table"}},
           {"bus = 'embedded', ", {"mission m", "bus", "embedded", "robot"}},
           {"robto = 'micro', ", {"mission m", "robto", "micro", "bus", "finish", "robot", "scene"}}}) {
    const Ended ended = run_program("eval mission " + mission(fields));
    EXPECT_EQ(ended.code, 2);
    EXPECT_TRUE(names(ended.error, facts)) << fields;
  }
}

TEST(Eval, WhatIsForCableArmsOnlyIsRefusedForOthersByName) {
  const TemporaryFolder folder;
  const auto eval = [&](const std::string& fields) { return error_of_step(folder, "--robot micro ", fields); };
  EXPECT_EQ(eval("device = 'none', run = liana.move_to 'prepare'"), "");
  for (const auto& [fields, op] :
       std::vector<std::pair<std::string, std::string>>{{"device = 'vr'", "use_device"},
                                                        {"device = 'none', hold = { [7] = 0 }", "hold_theta"},
                                                        {"device = 'none', run = liana.shape {}", "shape"}}) {
    EXPECT_TRUE(names(eval(fields), {op, "robot micro", "serial"}));
  }
}

// What is in an action, or asked for by a function before it looks at the arm.
TEST(Eval, WhatAPushNeedsOfRobotAndBusesIsRefusedBeforeTheStartByLineAndField) {
  const TemporaryFolder folder;
  const auto bus_without = [&](const std::string& what) {
    return "--robot macro_micro --bus " +
           folder.write("no_" + what + ".lua",
                        "local t = require 'buses.embedded_payload'\nt.buses[2]." + what + " = nil\nreturn t\n") +
           " ";
  };
  const std::string torque = "--robot macro_micro --bus embedded_payload ",
                    position = "--robot micro --bus embedded_micro ", deaf = bus_without("wrist_sensor"),
                    alone = bus_without("adapter");
  const auto eval = [&](const std::string& options, const std::string& run) {
    return error_of_step(folder, options, "device = 'none', run = " + run);
  };
  for (const auto& [options, run, facts] : std::vector<std::tuple<std::string, std::string, Facts>>{
           {position, "liana.insert {}", {"insert", "drives", "positions"}},
           {position, "function(arm) arm.insert {} end", {"insert", "drives", "positions"}},
           {position, "liana.comply()", {"comply", "drives", "positions"}},
           {position, "liana.adapter 'lock'", {"adapter", "bus table"}},
           {"", "liana.insert {}", {"insert", "robot zhu2022", "cable"}},
           {torque,
            "liana.follow_curve { points = {{0, 0, 0}, {1, 0, 0}} }",
            {"follow_curve", "cable arms", "macro_micro"}},
           {deaf, "liana.insert {}", {"insert", "bus table", "wrist_sensor"}},
           {alone, "function(arm) arm.comply() arm.adapter { command = 'lock' } end", {"adapter", "bus table"}},
           {torque,
            "liana.insert { force_N = 61 }",
            {"insert", "force_N", "61", "0", "60", "force_control", "macro_micro"}},
           {torque, "function(arm) arm.insert { force_N = 61 } end", {"insert", "force_N", "61", "0", "60"}},
           {torque, "liana.insert { force_N = 2000 }", {"insert", "force_N", "2000", "0", "1000"}},
           {torque, "liana.insert { forec_N = 20 }", {"insert", "unknown", "forec_N", "20", "axis", "force_N"}},
           {torque, "liana.insert { travel_m = 0.3 }", {"insert", "travel_m", "0.3", "0", "0.2"}},
           {torque, "liana.insert { turn_deg = 4 }", {"insert", "turn_deg", "4", "0", "3"}},
           {torque, "liana.insert { axis = { 0, 0, 0 } }", {"insert", "axis", "[0.0,0.0,0.0]", "length", "0.001"}},
           {torque, "liana.insert { gains = { mass_kg = 1 } }", {"insert", "gains.mass_kg", "1", "50", "5000"}},
           {torque,
            "liana.insert { law = 'impedance', depth_m = 0.1 }",
            {"insert", "depth_m", "0.1", "0", "0.06 m", "travel_m"}},
           {torque, "liana.payload { mass_kg = 5 }", {"payload", "inertia_kgm2", "0", "six"}},
           {torque,
            "liana.payload { mass_kg = 5, inertia_kgm2 = { 1, 1, 9, 0, 0, 0 } }",
            {"payload", "inertia_kgm2", "[1.0,1.0,9.0,0.0,0.0,0.0]"}},
           {torque, "liana.adapter 'open'", {"adapter", "command", "open", "lock", "release"}}}) {
    EXPECT_TRUE(names(eval(options, run), {"given.lua:3", "mission m", "step 1", "a", "run"})) << run;
    EXPECT_TRUE(names(eval(options, run), facts)) << run;
  }
  for (const std::string run :
       {"liana.insert { force_N = 60 }", "liana.comply()", "liana.payload { mass_kg = 0 }", "liana.adapter 'release'",
        "function(arm) if arm.state.tick > 3 then arm.insert { force_N = 99 } end end",
        "function(arm) arm.payload { mass_kg = later, inertia_kgm2 = later } arm.adapter { command = later } end"})
    EXPECT_EQ(eval(torque, run), "") << "nothing to refuse, or not known yet";
  EXPECT_TRUE(names(eval(position, "liana.push {}"), {"given.lua:3", "push", "insert"}));
  EXPECT_EQ(eval("--robot macro_micro ", "liana.insert {}"), "") << "buses that nobody names may have the sensor";
}

TEST(Eval, AMissionIsCheckedAgainstTheBusesThatItNamesWithItsRobot) {
  const TemporaryFolder folder;
  const std::string mission = folder.write(
      "given.lua",
      "local liana = require 'liana'\nreturn liana.mission 'm' { robot = 'micro', bus = 'embedded_micro',\n"
      "liana.step 'a' { device = 'none', run = liana.adapter 'lock', exit = liana.at_rest(), time_limit_s = 1,\n"
      "on_fail = 'hold' } }\n");
  const std::string other =
      folder.write("other.lua", "local t = require 'buses.embedded_micro'\nt.buses[1].adapter = 48\nreturn t\n");
  const std::string error = run_program("eval mission " + mission).error;
  EXPECT_TRUE(names(error, {"given.lua:3", "mission m", "step 1", "a", "run", "adapter", "bus table"}));
  const Ended ended = run_program("eval mission " + mission + " --bus " + other);
  ASSERT_EQ(ended.code, 0) << ended.error;
  EXPECT_EQ(Json::parse(ended.out)["steps"][0]["asks"], Json::parse(R"(["adapter"])"));
}

TEST(Eval, RefusesAMissionFileThatReturnsSomethingElse) {
  const TemporaryFolder folder;
  const Ended ended = run_program("eval mission " + folder.write("given.lua", "return {}"));
  EXPECT_EQ(ended.code, 2);
  EXPECT_TRUE(names(ended.error, {"given.lua", "return", "mission"}));
}

}  // namespace
}  // namespace liana::mission_runner
