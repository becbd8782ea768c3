#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "host/apps/mission_runner/mission_run.hpp"
#include "host/base/json/json.hpp"
#include "tests/lua/fake_lianad.hpp"
#include "tests/lua/program.hpp"
#include "tests/message.hpp"

namespace liana::mission_runner {
namespace {

// How one mission against the fake ended.
struct MissionRun {
  Ended ended;
  Json report;
  std::vector<Json> requests;

  std::vector<std::string> ops(const std::string& op) const {
    std::vector<std::string> found;
    for (const auto& request : requests) {
      if (request["op"] == op) found.push_back(request.dump());
    }
    return found;
  }
  std::string last_command() const {  // before announce and release at the end
    for (auto it = requests.rbegin(); it != requests.rend(); ++it) {
      if ((*it)["op"] != "announce" && (*it)["op"] != "release") return (*it)["op"];
    }
    return "";
  }
};

MissionRun run_mission_against(const FakeBehaviour& behaviour, const std::string& mission = "slit_crossing",
                               const std::string& flags = "") {
  const TemporaryFolder folder;
  FakeLianad lianad(folder.file("api"), behaviour);
  MissionRun run;
  run.ended = run_program("run --lockstep --api " + folder.file("api") + " --mission " + mission + " --report " +
                          folder.file("report.json") + flags);
  run.requests = lianad.requests();
  run.report = Json::parse_or_null(read_file(folder.file("report.json")));
  return run;
}

// A mission file of one step whose run and exit are given.
std::string one_step(const TemporaryFolder& folder, const std::string& body) {
  return folder.write("given.lua",
                      "local liana = require 'liana'\nreturn liana.mission 'given' { liana.step 'only' {\n" + body +
                          "\n device = 'none', time_limit_s = 5, on_fail = 'hold' } }\n");
}

// 10+0, 9+1, 8+2, then the repair command.
// req:A7 req:A40 req:A50
TEST(Mission, CrossesTheSlitInSixSteps) {
  const MissionRun run = run_mission_against({}, "slit_crossing", " --progress");
  ASSERT_EQ(run.ended.code, 0) << run.ended.error;
  EXPECT_EQ(run.report["outcome"], "success");
  const std::vector<std::string> devices = {"none", "vr", "none", "hand", "none", "hand"};
  const std::vector<std::vector<int>> held = {{}, {}, {9}, {9}, {7, 9}, {7, 9}};
  ASSERT_EQ(run.report["steps"].size(), 6u);
  for (std::size_t i = 0; i < 6; ++i) {
    const Json& step = run.report["steps"][i];
    EXPECT_EQ(step["device"], devices[i]);
    EXPECT_EQ(step["held_theta"], Json(held[i]));
    EXPECT_EQ(step["outcome"], "success");
    EXPECT_GT(step["end_tick"].get<int>(), step["start_tick"].get<int>());
    EXPECT_NEAR(step["duration_s"], (step["end_tick"].get<int>() - step["start_tick"].get<int>()) * 0.004, 1e-12);
  }
  EXPECT_EQ(run.ops("tool").size(), 1u);
  EXPECT_EQ(run.report["repair_tick"], run.report["steps"][5]["end_tick"]);
  EXPECT_TRUE(names(run.ended.out, {"4/6", "segment 5 into the slit"}));
}

TEST(Mission, SendsWhatTheApiPageSays) {
  const MissionRun run = run_mission_against({});
  ASSERT_FALSE(run.requests.empty());
  EXPECT_EQ(run.requests[0]["role"], "mission");
  EXPECT_EQ(run.requests[0]["lockstep"], true);
  EXPECT_EQ(run.requests[1]["op"], "acquire");
  const auto holds = run.ops("hold_theta");
  ASSERT_EQ(holds.size(), 2u);
  EXPECT_EQ(Json::parse(holds[1])["held"], Json::parse(R"([{"theta":7,"target_deg":0},{"theta":9,"target_deg":0}])"));
  EXPECT_EQ(Json::parse(run.ops("use_device")[0])["node"], 3);
  EXPECT_EQ(Json::parse(run.ops("use_device")[1])["device"], "none");  // nobody steers between the steps
  EXPECT_EQ(Json::parse(run.ops("announce")[1])["step"]["device"], "vr");
  EXPECT_FALSE(Json::parse(run.ops("announce").back()).contains("step")) << "the mission has ended";
  EXPECT_EQ(run.requests.back()["op"], "release");
}

TEST(Mission, TwoRunsSendIdenticalRequests) {
  EXPECT_EQ(run_mission_against({}).requests, run_mission_against({}).requests);
}

TEST(Mission, PrintsJsonLinesForPrograms) {
  const MissionRun run = run_mission_against({}, "slit_crossing", " --json");
  std::istringstream lines(run.ended.out);
  int count = 0;
  Json last;
  for (std::string line; std::getline(lines, line); ++count) last = Json::parse(line);
  EXPECT_EQ(count, 13);  // begin and end of six steps, the report
  EXPECT_EQ(last["outcome"], "success");
}

TEST(Mission, HoldsWhenTheOperatorDoesNotArriveInTime) {
  const MissionRun run = run_mission_against({.operator_arrives = false});
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_EQ(run.last_command(), "hold");
  ASSERT_EQ(run.report["steps"].size(), 2u);
  EXPECT_TRUE(names(run.ended.error, {"120 s", "device", "operator", "arrived"}));
}

// The only way out of the slit is the verified path backwards.
TEST(Mission, RetractsOutOfTheSlitToWhereItEntered) {
  const MissionRun run = run_mission_against({.tip_in_slit_u_m = 2.5});
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_EQ(run.report["outcome"], "aborted");
  ASSERT_EQ(run.ops("retract").size(), 1u);
  EXPECT_EQ(Json::parse(run.ops("retract")[0])["until_tick"], run.report["steps"][3]["start_tick"]);
  EXPECT_EQ(run.report["steps"][3]["outcome"], "failed");
}

TEST(Mission, ARefusalEndsItAsRefusedAndHolds) {
  const MissionRun run = run_mission_against({.refuse = {{"hold_theta", "out_of_range"}}});
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_EQ(run.report["outcome"], "refused");
  EXPECT_EQ(run.last_command(), "hold");
  EXPECT_NE(run.report["reason"].get<std::string>().find("hold_theta refused: out_of_range"), std::string::npos);
}

TEST(Mission, ARefusalInTheSlitRetracts) {
  const MissionRun run = run_mission_against({.refuse = {{"use_device", "no_device"}}, .refuse_in_step = 6});
  EXPECT_EQ(run.report["outcome"], "aborted");
  EXPECT_EQ(run.last_command(), "retract");
}

TEST(Mission, ARefusedRetractionHoldsAndSaysSo) {
  const MissionRun run =
      run_mission_against({.refuse = {{"use_device", "no_device"}, {"retract", "refused"}}, .refuse_in_step = 6});
  EXPECT_EQ(run.report["outcome"], "refused");
  EXPECT_NE(run.report["reason"].get<std::string>().find("retract refused"), std::string::npos);
}

TEST(Mission, AWayBackThatEndsEarlyIsAFailureAndSaysSo) {
  const MissionRun run = run_mission_against({.way_back_ends_early = true, .tip_in_slit_u_m = 2.5});
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_TRUE(names(run.report["reason"].get<std::string>(), {"42 points", "ten times"})) << run.report;
}

TEST(Mission, AWayBackThatComesOnNoFurtherEndsInBoundedTime) {
  const MissionRun run = run_mission_against({.way_back_stalls = true, .tip_in_slit_u_m = 2.5});
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_TRUE(names(run.report["reason"].get<std::string>(), {"60 s", "7 points"})) << run.report;
  EXPECT_EQ(run.last_command(), "hold");
}

// Two steps that go to a pose; `fields` are those of the second.
std::string two_steps(const TemporaryFolder& folder, const std::string& fields) {
  const std::string to = "device = 'none', run = liana.move_to 'prepare', exit = liana.at_rest(), time_limit_s = 5, ";
  return folder.write("given.lua",
                      "local liana = require 'liana'\nreturn liana.mission 'given' {\n liana.step 'one' { " + to +
                          "on_fail = 'hold' },\n liana.step 'two' { " + to + fields + " } }\n");
}

std::vector<std::string> waits_of(const MissionRun& run) {
  std::vector<std::string> waits;
  for (const std::string& announce : run.ops("announce")) {
    const Json step = Json::parse(announce).member_or_null("step");
    if (step.is_object() && step.contains("waits")) waits.push_back(step["waits"]);
  }
  return waits;
}

TEST(Mission, IsPausedAndGoesOnWhenPeopleSaySo) {
  const MissionRun run = run_mission_against({.people = {{2, "pause"}, {2, "resume"}}});
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  EXPECT_EQ(run.ops("hold").size(), 1u);
  EXPECT_EQ(waits_of(run), (std::vector<std::string>{"paused: asked for by ann"}));
  EXPECT_EQ(run.ops("use_device").size(), 8u) << "given back for the pause, and taken again";
}

// Half a second under way and half a second paused in turn: 8.5 s, of which 4.5 s count.
TEST(Mission, APauseIsNoPartOfTheTimeOfItsStep) {
  const TemporaryFolder folder;
  std::vector<std::pair<int, std::string>> people;
  for (int i = 0; i < 8; ++i) people.insert(people.end(), {{1, "pause"}, {1, "resume"}});
  const std::string mission =
      one_step(folder, "exit = liana.condition('late', function(arm) return arm.elapsed_s(arm.begin_tick) > 8 end),");
  const MissionRun run = run_mission_against({.people = people}, mission);
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  EXPECT_EQ(waits_of(run).size(), 8u);
}

TEST(Mission, GoesOneStepAtATimeUntilItIsToldToResume) {
  const MissionRun run = run_mission_against({.people = {{2, "step"}, {3, "step"}, {4, "resume"}}});
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  const std::vector<std::string> waits = waits_of(run);
  ASSERT_EQ(waits.size(), 2u);
  EXPECT_TRUE(names(waits[0], {"paused", "one step"}));
  EXPECT_EQ(waits[0], waits[1]);
}

TEST(Mission, AStepThatPeopleHaveToConfirmBeginsWhenTheyDo) {
  const TemporaryFolder folder;
  const std::string mission = two_steps(folder, "on_fail = 'hold', confirm = 'cover removed'");
  const MissionRun run = run_mission_against({.people = {{2, "confirm"}}}, mission);
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  EXPECT_EQ(waits_of(run), (std::vector<std::string>{"confirm: cover removed"}));
  EXPECT_EQ(run.ops("move_jp").size(), 2u);
  const MissionRun refused = run_mission_against({.people = {{2, "abort"}}}, mission);
  EXPECT_EQ(refused.report["outcome"], "aborted");
  EXPECT_EQ(refused.report["reason"], "ended by ann");
  EXPECT_EQ(refused.ops("move_jp").size(), 1u);
}

TEST(Mission, GoesOnFromItsStepAfterAFaultWasCleared) {
  const TemporaryFolder folder;
  const MissionRun run =
      run_mission_against({.hold_fault_in_step = 2, .people = {{2, "resume"}}, .hold_fault_goes = true},
                          two_steps(folder, "on_fail = 'pause'"));
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  EXPECT_EQ(run.ops("acquire").size(), 2u) << "others may own motion meanwhile: to clear";
  ASSERT_EQ(waits_of(run).size(), 1u);
  EXPECT_NE(waits_of(run)[0].find("failed: fault 5001 cable_slack"), std::string::npos);
  ASSERT_EQ(run.report["steps"].size(), 3u) << "the one that failed stays in the report";
  EXPECT_EQ(run.report["steps"][1]["outcome"], "failed");
  EXPECT_EQ(run.report["steps"][2]["index"], 2);
}

TEST(Mission, ThatWaitsAfterAFaultIsEndedBySomebodyToo) {
  const TemporaryFolder folder;
  const MissionRun run =
      run_mission_against({.hold_fault_in_step = 2, .people = {{2, "abort"}}}, two_steps(folder, "on_fail = 'pause'"));
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_NE(run.report["reason"].get<std::string>().find("cable_slack"), std::string::npos);
  EXPECT_NE(run.report["reason"].get<std::string>().find("ended by ann"), std::string::npos);
}

TEST(Mission, IsPatientWhileDrivesBootAndThenSaysWhy) {
  const MissionRun run = run_mission_against({.refuse = {{"state_command", "busy"}}});
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_GT(run.ops("state_command").size(), 10u);
  EXPECT_LT(run.ops("state_command").size(), 60u);
  EXPECT_TRUE(names(run.report["reason"].get<std::string>(), {"60 s", "state_command", "busy"})) << run.report;
}

TEST(Mission, DoesNotMoveWhenMotionBelongsToAnother) {
  const MissionRun run = run_mission_against({.refuse = {{"acquire", "not_owner"}}});
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_EQ(run.report["outcome"], "refused");
  EXPECT_TRUE(run.ops("state_command").empty());
  EXPECT_TRUE(run.ops("move_jp").empty());
}

TEST(Mission, GivesUpWhenAnotherTakesMotion) {
  const MissionRun run = run_mission_against({.steal_in_step = 2});
  EXPECT_EQ(run.report["outcome"], "aborted");
  EXPECT_NE(run.report["reason"].get<std::string>().find("somebody"), std::string::npos);
}

TEST(Mission, ADriveFaultFailsItByNameAndNumber) {
  const MissionRun run = run_mission_against({.fault_in_step = 4});
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_NE(run.report["reason"].get<std::string>().find("3101 drive_silent: drive 4 (node 4, segment 2)"),
            std::string::npos)
      << run.report;
  EXPECT_TRUE(run.ops("retract").empty());  // the drives are stopped: there is nothing to command
}

TEST(Mission, AnEmergencyStopAbortsIt) {
  const MissionRun run = run_mission_against({.stop_in_step = 2});
  EXPECT_EQ(run.report["outcome"], "aborted");
  EXPECT_EQ(run.report["steps"][1]["outcome"], "aborted");
}

TEST(Mission, TheEndOfLianadIsReported) {
  const MissionRun run = run_mission_against({.vanish_in_step = 3});
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_EQ(run.report["steps"].size(), 3u);
  EXPECT_EQ(run.report["steps"][2]["outcome"], "failed");
}

TEST(Mission, AStepThatWasCutOffLastedUntilTheLastState) {
  const TemporaryFolder folder;
  const MissionRun run =
      run_mission_against({}, one_step(folder,
                                       "exit = liana.condition('never', function(arm) if arm.elapsed_s(arm.begin_tick) "
                                       "> 1 then xpcall(error, function() while true do end end) end end),"));
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_GT(run.report["steps"][0]["duration_s"].get<double>(), 1.0);
  EXPECT_EQ(run.report["duration_s"], run.report["steps"][0]["duration_s"]);
}

TEST(Mission, AFaultThatOnlyHoldsTheArmFailsTheStepThoughTheArmIsAtRest) {
  const MissionRun run = run_mission_against({.hold_fault_in_step = 1});
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_EQ(run.report["steps"][0]["outcome"], "failed");
  EXPECT_NE(run.report["reason"].get<std::string>().find("fault 5001 cable_slack: drive 3 (node 3, segment 1)"),
            std::string::npos)
      << run.report;
  EXPECT_EQ(run.last_command(), "hold");
}

TEST(Mission, AMotionOfTheScriptThatVerificationRefusesFailsItsStepWithTheReason) {
  const MissionRun run = run_mission_against({.refuse_motion_in_step = 3});
  EXPECT_EQ(run.report["outcome"], "refused");
  EXPECT_EQ(run.report["steps"][2]["outcome"], "refused");
  EXPECT_TRUE(names(run.report["reason"].get<std::string>(), {"refused", "joint rate 1.2"})) << run.report;
}

TEST(Mission, ARefusalWhileTheOperatorSteersIsPartOfSteering) {
  const MissionRun run = run_mission_against({.refuse_motion_in_step = 6});
  EXPECT_EQ(run.report["outcome"], "success") << run.report;
}

TEST(Mission, ATimeLimitThatPassesDuringAMoveSaysSo) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {},
      one_step(folder,
               "exit = liana.condition('never', function(arm) arm.move_jp { goal_deg = arm.named_pose 'zero' } end),"));
  EXPECT_TRUE(names(run.ended.error, {"5 s", "moving", "never"}));
}

// A step of a hand that never arrives; the fake grips after 0.2 s.
std::string hand_step(const TemporaryFolder& folder) {
  return folder.write(
      "given.lua",
      "local liana = require 'liana'\nreturn liana.mission 'given' { liana.step 'led' { device = 'vr',\n"
      "exit = liana.released(), time_limit_s = 5, on_fail = 'hold' } }\n");
}

TEST(Mission, TimeInWhichAHandIsSlowedCountsByItsShareAndByATenthAtLeast) {
  for (const auto& [share, lasts_s] :
       std::map<double, double>{{-3.0, 48.2}, {0.0, 48.2}, {0.25, 19.4}, {0.5, 9.8}, {1.0, 5.0}, {7.0, 5.0}}) {
    const TemporaryFolder folder;
    const MissionRun run = run_mission_against({.operator_arrives = false, .speed_share = share}, hand_step(folder));
    ASSERT_EQ(run.report["steps"].size(), 1u) << run.ended.error;
    EXPECT_NEAR(run.report["steps"][0]["duration_s"].get<double>(), lasts_s, 0.2) << share;
    EXPECT_EQ(run.ended.error.find("time limit of 5 s passed") == std::string::npos, share < 1.0) << run.ended.error;
  }
}

TEST(Mission, AStopForAReasonTooLongForAPacketIsStillSent) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {}, folder.write("given.lua",
                       "local liana = require 'liana'\nreturn liana.mission 'given' { liana.step 'only' {\n"
                       "exit = liana.condition(('long '):rep(20000), function() return false end),\n"
                       "device = 'none', time_limit_s = 1, on_fail = 'stop' } }\n"));
  EXPECT_EQ(run.ended.code, 1);
  ASSERT_EQ(run.ops("stop").size(), 1u) << run.ended.error.substr(0, 500);
  EXPECT_EQ(run.last_command(), "stop");
  EXPECT_LT(run.ops("stop")[0].size(), 300u);
}

TEST(Mission, ACurveIsPlannedFromWhereTheArmStandsAndGoesToLianadAsAPath) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against({}, one_step(folder, R"(
    run = function(arm)
      local curve = { points = { arm.tip(), { arm.tip()[1] + 0.02, arm.tip()[2], arm.tip()[3] } } }
      liana.follow_curve(curve)(arm)
      liana.follow_back(curve)(arm)
    end,
    exit = liana.condition('soon', function(arm) return arm.elapsed_s(arm.begin_tick) > 0.2 end),)"));
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  const std::vector<std::string> paths = run.ops("move_path");
  ASSERT_EQ(paths.size(), 2u);
  const Json there = Json::parse(paths[0]), back = Json::parse(paths[1]);
  ASSERT_GE(there.at("points_deg").size(), 2u);
  EXPECT_EQ(there.at("points_deg").front(), back.at("points_deg").back());
  EXPECT_EQ(there.at("points_deg").back(), back.at("points_deg").front());
  EXPECT_EQ(there.value("margin_m", 0.0), 0.005);
}

TEST(Mission, ACurveThatCannotBeFollowedFailsTheStepAndSaysWhy) {
  const auto reason_of = [](const std::string& run) {
    const TemporaryFolder folder;
    return run_mission_against({}, one_step(folder, run + ", exit = liana.curve_followed(),")).ended.error;
  };
  EXPECT_TRUE(names(reason_of("run = liana.follow_curve { points = { { 0, 0, 0 }, { 0.1, 0, 0 } } }"),
                    {"error in run", "follow_curve", "begins", "mm from the tip"}));
  EXPECT_TRUE(names(reason_of("run = liana.follow_curve { points = { { 0, 0, 0 }, { 0, 0, 0.0001 } } }"),
                    {"follow_curve", "points[2]", "1 mm apart"}));
  EXPECT_TRUE(names(reason_of("run = liana.follow_back { points = { { 0, 0, 0 }, { 1, 0, 0 } } }"),
                    {"follow_back", "no step has followed"}));
  EXPECT_TRUE(
      names(reason_of("run = liana.follow_curve { point = 1 }"), {"given.lua:3", "follow_curve", "curve.point"}));
  EXPECT_TRUE(
      names(reason_of("run = liana.follow_curve { points = {} }"), {"given.lua:3", "follow_curve", "2 points"}));
}

TEST(Mission, AnErrorInAStepNamesFileAndLineAndHolds) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {}, one_step(folder, "run = function(arm) local x = arm.nothing.at_all end, exit = liana.at_rest(),"));
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_EQ(run.last_command(), "hold");
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_EQ(run.report["steps"][0]["outcome"], "failed");
  EXPECT_TRUE(names(run.ended.error, {"given.lua:3", "nothing"}));
}

// Errors of every kind, wherever the script is asked: what has to follow a failure is done.
TEST(Mission, AnErrorWhereverAStepAsksTheScriptRunsOnFail) {
  const std::string fails = "local function fails(arm) if arm.elapsed_s(arm.begin_tick) > 0.3 then %s end end\n";
  const std::map<std::string, std::string> errors = {
      {"error 'too cold'", "given.lua:2: too cold"},
      {"while true do end", "computes too long"},
      {"local t = {} while true do t[#t + 1] = {} end", "too much memory"},
      {"local x = 1 + {}", "attempt to perform arithmetic"}};
  const std::map<std::string, std::string> steps = {
      {"exit", "exit = liana.all { liana.any { liana.condition('c', fails) } }"},
      {"fail_when",
       "exit = liana.condition('no', function() return false end), fail_when = liana.condition('c', fails)"},
      {"enter", "exit = liana.at_rest(), enter = liana.condition('c', fails)"},
      {"run", "exit = liana.at_rest(), run = function(arm) fails({ elapsed_s = function() return 1 end }) end"}};
  const TemporaryFolder folder;
  for (const auto& [code, text] : errors) {
    for (const auto& [field, step] : steps) {
      std::string head = fails;
      const std::string mission = folder.write(
          "given.lua",
          "local liana = require 'liana'\n" + head.replace(head.find("%s"), 2, code) +
              "return liana.mission 'given' { liana.step 'only' { device = 'none', time_limit_s = 5, on_fail = "
              "'retract', " +
              step + " } }\n");
      const MissionRun run = run_mission_against({}, mission);
      EXPECT_EQ(run.ended.code, 1) << field << " " << code;
      EXPECT_EQ(run.last_command(), "retract") << field << " " << code;
      EXPECT_EQ(run.report["outcome"], "aborted") << field << " " << code;
      const std::string reason = run.report["reason"];
      EXPECT_NE(reason.find("error in " + field + ": "), std::string::npos) << reason;
      EXPECT_NE(reason.find(text), std::string::npos) << reason;
    }
  }
}

TEST(Mission, WhatAStepFailsWhenItIsMetEndsItByName) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {},
      folder.write("given.lua",
                   "local liana = require 'liana'\n"
                   "local function after(s) return function(arm) return arm.elapsed_s(arm.begin_tick) > s end end\n"
                   "return liana.mission 'given' { liana.step 'only' { device = 'none', time_limit_s = 5, on_fail = "
                   "'retract', exit = liana.condition('later', after(0.5)), fail_when = liana.any { "
                   "liana.condition('never', after(9)), liana.condition('half a second', after(0.5)) } } }\n"));
  EXPECT_EQ(run.report["outcome"], "aborted");
  EXPECT_EQ(run.report["steps"][0]["outcome"], "failed") << "looked at before exit";
  EXPECT_EQ(run.report["steps"][0]["ended_by"], "half a second");
  EXPECT_EQ(run.report["steps"][0]["reason"], "fail_when: half a second");
  EXPECT_EQ(run.last_command(), "retract");
}

// Steps a, b, c, ...: each with what it gives, ended by what `ends` says it is.
std::string steps_with(const TemporaryFolder& folder, const std::vector<std::string>& fields,
                       const std::string& head = "") {
  std::string text =
      "local liana = require 'liana'\nlocal function c(name, met) return liana.condition(name, met or "
      "function() return true end) end\nlocal function after(s) return c(s .. ' s', function(arm) return "
      "arm.elapsed_s(arm.begin_tick) > s end) end\n" +
      head + "return liana.mission 'given' {\n";
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const bool says = fields[i].find("exit =") != std::string::npos || fields[i].find("plan =") != std::string::npos;
    const std::string own = says ? "" : "exit = c 'done', ";
    text += std::string("liana.step '") + static_cast<char>('a' + i) +
            "' { device = 'none', time_limit_s = 5, on_fail = 'retract', " + own + fields[i] + " },\n";
  }
  return folder.write("given.lua", text + "}\n");
}

std::string order_of(const MissionRun& run) {
  std::string names;
  for (const Json& step : run.report["steps"]) names += step["name"].get<std::string>();
  return names;
}

TEST(Mission, GoesOnWhereNextLeads) {
  const TemporaryFolder folder;
  const auto order = [&](const std::vector<std::string>& fields, const std::string& head = "") {
    const MissionRun run = run_mission_against({}, steps_with(folder, fields, head));
    EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
    return order_of(run);
  };
  EXPECT_EQ(order({"next = { { step = 'c' }, { step = 'b', on = 'failure' } }", "next = 'finish'", "next = 'finish'"}),
            "ac");
  EXPECT_EQ(order({"", "next = { step = 'a', at_most = 2 }", ""}), "abababc");
  EXPECT_EQ(
      order({"", "next = { { step = 'a', when = c 'yes', at_most = 1 }, { step = 'finish', when = c 'yes' } }", ""}),
      "abab");
  EXPECT_EQ(order({"next = { step = 'c', when = c('no', function() return false end) }", "", ""}), "abc");
  EXPECT_EQ(order({"exit = liana.any { after(9), fast }, next = { { step = 'b', when = after(9) }, { step = 'c', when "
                   "= fast } }",
                   "next = 'finish'", ""},
                  "local fast = after(0.2)\n"),
            "ac")
      << "by the condition that ended the step";
}

TEST(Mission, AStepThatFallsShortIsFollowedByTheStepNextNamesForThat) {
  const TemporaryFolder folder;
  const std::string never = "exit = after(99), ", again = "next = { step = 'b', on = 'failure' }";
  for (const std::string& fails : std::vector<std::string>{"time_limit_s = 0.5, ", "fail_when = after(0.2), ",
                                                           "enter = after(99), enter_limit_s = 0.5, "}) {
    const MissionRun run =
        run_mission_against({}, steps_with(folder, {never + fails + again, "run = liana.move_to 'prepare'"}));
    EXPECT_EQ(run.report["outcome"], "success") << fails << run.ended.error;
    EXPECT_EQ(order_of(run), "ab");
    EXPECT_EQ(run.report["steps"][0]["outcome"], "failed") << fails;
    EXPECT_EQ(run.report["steps"][0]["next"], "b");
    EXPECT_EQ(run.ops("hold").size(), 1u) << "at rest first";
    EXPECT_TRUE(run.ops("retract").empty());
  }
  const std::string twice = never + "fail_when = after(0.2), next = { step = 'a', on = 'failure', at_most = 2 }";
  const MissionRun spent = run_mission_against({}, steps_with(folder, {twice}));
  EXPECT_EQ(order_of(spent), "aaa");
  EXPECT_EQ(spent.last_command(), "retract") << "and then what on_fail says";
  EXPECT_EQ(spent.report["outcome"], "aborted");
  const MissionRun refused = run_mission_against({.refuse = {{"move_jp", "out_of_range"}}},
                                                 steps_with(folder, {"run = liana.move_to 'prepare', " + again, ""}));
  EXPECT_EQ(order_of(refused), "ab") << refused.ended.error;
  EXPECT_EQ(refused.report["steps"][0]["outcome"], "refused");
}

TEST(Mission, FaultsAndErrorsOfTheScriptAreNoFailureThatNextLeadsOnFrom) {
  const TemporaryFolder folder;
  const std::string again = ", next = { step = 'b', on = 'failure' }";
  const MissionRun fault =
      run_mission_against({.hold_fault_in_step = 1}, steps_with(folder, {"exit = after(3)" + again, ""}));
  EXPECT_EQ(order_of(fault), "a");
  EXPECT_EQ(fault.last_command(), "retract");
  const MissionRun error =
      run_mission_against({}, steps_with(folder, {"exit = c('c', function() error 'x' end)" + again, ""}));
  EXPECT_EQ(order_of(error), "a");
  const MissionRun in_next = run_mission_against(
      {}, steps_with(folder, {"next = { step = 'b', when = c('c', function() error 'x' end) }", ""}));
  EXPECT_EQ(order_of(in_next), "a");
  EXPECT_NE(in_next.report["reason"].get<std::string>().find("error in next: "), std::string::npos) << in_next.report;
}

// Booting (tick 0 to 55), asked to enable, and ENABLING (to tick 200); a state has five ticks.
constexpr int kBeforeTheFirstStep[] = {0, 1, 11, 12, 25};

TEST(Mission, AnAbortBeforeTheFirstStepEndsItAndTakesPowerAway) {
  const TemporaryFolder folder;
  const std::string mission = two_steps(folder, "on_fail = 'hold'");
  for (const int interval : kBeforeTheFirstStep) {
    const MissionRun run = run_mission_against({.people = {{0, "abort"}}, .people_after_intervals = interval}, mission);
    EXPECT_EQ(run.report["outcome"], "aborted") << interval;
    EXPECT_EQ(run.report["reason"], "ended by ann") << interval;
    EXPECT_TRUE(run.report["steps"].empty()) << interval;
    EXPECT_TRUE(run.ops("move_jp").empty()) << interval;
    const std::vector<std::string> asked = run.ops("state_command");
    const auto is_enable = [](const std::string& request) { return Json::parse(request)["command"] == "enable"; };
    if (std::any_of(asked.begin(), asked.end(), is_enable)) {
      EXPECT_EQ(Json::parse(asked.back())["command"], "disable") << interval;
    }
  }
}

TEST(Mission, APauseBeforeTheFirstStepHoldsWhereThatBegins) {
  const TemporaryFolder folder;
  const std::string mission = two_steps(folder, "on_fail = 'hold'");
  for (const int interval : kBeforeTheFirstStep) {
    const MissionRun aborted =
        run_mission_against({.people = {{0, "pause"}, {1, "abort"}}, .people_after_intervals = interval}, mission);
    EXPECT_EQ(aborted.report["outcome"], "aborted") << interval;
    EXPECT_EQ(waits_of(aborted), (std::vector<std::string>{"paused: asked for by ann"})) << interval;
    EXPECT_TRUE(aborted.ops("move_jp").empty()) << interval;
  }
  const MissionRun resumed = run_mission_against({.people = {{0, "pause"}, {1, "resume"}}}, mission);
  EXPECT_EQ(resumed.report["outcome"], "success") << resumed.ended.error;
  EXPECT_EQ(resumed.ops("move_jp").size(), 2u);
  for (const std::string& taken_back : std::vector<std::string>{"resume", "step"}) {
    const MissionRun run = run_mission_against(
        {.people = {{0, "pause"}, {0, taken_back}, {2, "resume"}}, .people_after_intervals = 12}, mission);
    EXPECT_EQ(run.report["outcome"], "success") << taken_back;
    EXPECT_EQ(waits_of(run).size(), taken_back == "step" ? 1u : 0u) << taken_back;
  }
}

TEST(Mission, AnAbortActsInAStepInAPauseAndRightAfterResume) {
  const TemporaryFolder folder;
  const std::string mission = two_steps(folder, "on_fail = 'pause'");
  const std::vector<std::vector<std::pair<int, std::string>>> orders = {
      {{1, "abort"}}, {{1, "pause"}, {1, "abort"}}, {{1, "pause"}, {1, "resume"}, {1, "abort"}}};
  for (const auto& people : orders) {
    const MissionRun run = run_mission_against({.people = people, .people_after_intervals = 3}, mission);
    EXPECT_EQ(run.report["outcome"], "aborted") << people.size();
    EXPECT_EQ(run.report["reason"], "ended by ann") << people.size();
    EXPECT_EQ(order_of(run), "one") << people.size();
    EXPECT_EQ(run.last_command(), "hold") << people.size();
  }
  // The pause comes with the fault, which counts first; the abort in the only interval of boot.
  const MissionRun after_a_fault = run_mission_against({.hold_fault_in_step = 2,
                                                        .people = {{2, "pause"}, {2, "resume"}, {2, "abort"}},
                                                        .people_after_intervals = 1,
                                                        .hold_fault_goes = true},
                                                       mission);
  EXPECT_EQ(after_a_fault.report["outcome"], "aborted");
  EXPECT_EQ(after_a_fault.report["reason"], "ended by ann");
  EXPECT_EQ(after_a_fault.report["steps"].size(), 2u) << "the failed step does not begin anew";
}

TEST(Mission, BetweenTwoStepsAnAbortEndsItAndAPauseHoldsTheSecond) {
  const TemporaryFolder folder;
  const std::string move = "run = liana.move_to 'prepare', ";
  const std::string mission = steps_with(
      folder, {move + "exit = after(99), fail_when = after(0.1), next = { step = 'b', on = 'failure' }", move});
  // Step a has failed after 0.1 s, and its motion ends at 0.4 s.
  const MissionRun aborted = run_mission_against({.people = {{1, "abort"}}, .people_after_intervals = 12}, mission);
  EXPECT_EQ(order_of(aborted), "a");
  EXPECT_EQ(aborted.report["outcome"], "aborted");
  const MissionRun paused =
      run_mission_against({.people = {{1, "pause"}, {2, "abort"}}, .people_after_intervals = 12}, mission);
  EXPECT_EQ(order_of(paused), "ab");
  EXPECT_EQ(waits_of(paused), (std::vector<std::string>{"paused: asked for by ann"}));
  EXPECT_EQ(paused.ops("move_jp").size(), 1u);
}

TEST(Mission, APauseHoldsTheWayBackWhichGoesOnWhenPeopleSaySoOrAbort) {
  const TemporaryFolder folder;
  const std::string mission = steps_with(folder, {"exit = after(99), fail_when = after(0.1)"});
  for (const std::string& word : std::vector<std::string>{"resume", "abort"}) {
    const MissionRun run = run_mission_against(
        {.way_back_stalls = true, .people = {{1, "pause"}, {1, word}}, .people_after_intervals = 12}, mission);
    EXPECT_EQ(run.ops("retract").size(), 2u) << word;
    EXPECT_EQ(run.ops("hold").size(), 2u) << word << ": one at the pause, one when the way back stalls";
    EXPECT_EQ(waits_of(run), (std::vector<std::string>{"paused: asked for by ann"})) << word;
    EXPECT_TRUE(names(run.report["reason"].get<std::string>(), {"fail_when", "60 s", "7 points"})) << run.report;
  }
}

TEST(Mission, AnAbortBehindTheLastStepHoldsAndDoesNotRetract) {
  const TemporaryFolder folder;
  const MissionRun run =
      run_mission_against({.people = {{1, "abort"}}, .people_after_intervals = 8}, steps_with(folder, {""}));
  ASSERT_EQ(run.report["steps"].size(), 1u);
  EXPECT_EQ(run.report["steps"][0]["outcome"], "success") << "it was over";
  EXPECT_EQ(run.report["outcome"], "aborted");
  EXPECT_TRUE(run.ops("retract").empty());
}

TEST(Mission, WhatTheOperatorSaidBeforeTheStepDoesNotEndIt) {
  const TemporaryFolder folder;
  const std::string mission = steps_with(folder, {"", "exit = liana.operator_says 'arrived'"});
  const MissionRun run = run_mission_against({.operator_speaks_too_early = true}, mission);
  ASSERT_EQ(run.report["steps"].size(), 2u);
  EXPECT_EQ(run.report["steps"][1]["outcome"], "failed");
}

TEST(Mission, NoRunHasMoreThanAThousandSteps) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against({}, steps_with(folder, {"", "next = { step = 'a', at_most = 1000 }"}));
  EXPECT_EQ(run.report["steps"].size(), 1000u);
  EXPECT_TRUE(names(run.report["reason"].get<std::string>(), {"1000 steps"}));
  EXPECT_EQ(run.last_command(), "retract");
}

// Json of the steps a, b, ... with this outcome and way on.
Json step_of(const char* name, const char* outcome, const char* next = nullptr) {
  Json step{{"name", name}, {"outcome", outcome}, {"start_tick", 7}, {"end_tick", 7}};
  if (next != nullptr) step["next"] = next;
  return step;
}

TEST(GrowingReport, IsAsLongAsItsStepsAndWholeAtAnyTime) {
  Activity activity;
  GrowingReport report(activity);
  const auto take = [&](int before, const Json::Array& steps, const char* outcome = "failed") {
    report.take({{"mission", "m"}, {"outcome", outcome}, {"steps_before", before}, {"steps", steps}});
    EXPECT_EQ(Json::parse(activity.report.data()), report.whole());
    return report.whole()["steps"];
  };
  EXPECT_EQ(take(0, {}), Json::array());
  EXPECT_EQ(take(0, {step_of("a", "running")}), Json::array({step_of("a", "running")}));
  take(0, {step_of("a", "success")});
  take(0, {step_of("a", "success", "b"), step_of("b", "running")});
  const Json all = Json::array({step_of("a", "success", "b"), step_of("b", "failed"), step_of("c", "running")});
  EXPECT_EQ(take(1, {step_of("b", "failed"), step_of("c", "running")}, "aborted"), all);
  EXPECT_EQ(report.whole()["outcome"], "aborted");
  EXPECT_EQ(Json::parse(failed_report(activity, "m", "killed"))["steps"][2]["reason"], "killed");
}

TEST(GrowingReport, WithoutRoomIsKeptAsItLastFitted) {
  Activity activity;
  GrowingReport report(activity);
  const std::string name(activity.report.size() / 3, 'x');
  for (int before = 0; before < 4; ++before)
    report.take({{"steps_before", before}, {"steps", Json::Array{step_of(name.c_str(), "success")}}, {"outcome", ""}});
  EXPECT_EQ(Json::parse(activity.report.data())["steps"].size(), 2u);
  EXPECT_EQ(report.whole()["steps"].size(), 4u);
}

TEST(Mission, AllStepsOfARunThatWasKilledAreInItsReport) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {}, steps_with(folder, {"", "next = { step = 'a', at_most = 20 }",
                              "exit = liana.condition('never', function() xpcall(error, function() while true do end "
                              "end) end)"}));
  ASSERT_EQ(run.report["steps"].size(), 43u);
  EXPECT_EQ(run.report["steps"][1]["next"], "a");
  EXPECT_EQ(run.report["steps"][40]["outcome"], "success");
  EXPECT_EQ(run.report["steps"][42]["outcome"], "failed");
}

TEST(Mission, WhatIsHeldFollowsTheWayThatWasTaken) {
  const TemporaryFolder folder;
  const MissionRun run =
      run_mission_against({}, steps_with(folder, {"hold = { [9] = 0 }, next = 'c'", "hold = {}, next = 'finish'", "",
                                                  "next = { step = 'b' , at_most = 1 }"}));
  EXPECT_EQ(order_of(run), "acdb") << run.ended.error;
  EXPECT_EQ(run.report["steps"][1]["held_theta"], Json({9}));
  EXPECT_EQ(run.ops("hold_theta").size(), 2u);
}

TEST(Mission, APlanIsAStepBetweenOthersAndWhatItNeedsIsRequiredFromBesideTheMission) {
  const TemporaryFolder folder;
  const std::string start = "[-8.5,0,-12,0,8,-2,13,0,12,-2]", end = "[-7.5,0,-12,0,8,-2,13,0,12,-1]";
  folder.write("way.json",
               R"({"outcome":"solved","inputs":{"margin_m":0.004},"waypoints_deg":[)" + start + "," + end + "]}");
  folder.write("helpers.lua", "return { pose = 'prepare' }\n");
  const MissionRun planned = run_mission_against(
      {}, steps_with(folder, {"run = liana.move_to(require('helpers').pose)", "plan = 'way.json'", ""}));
  EXPECT_EQ(planned.report["outcome"], "success") << planned.ended.error;
  EXPECT_EQ(order_of(planned), "abc");
  ASSERT_EQ(planned.ops("move_path").size(), 1u);
  EXPECT_EQ(Json::parse(planned.ops("move_path")[0])["points_deg"], Json::parse("[" + start + "," + end + "]"));
  EXPECT_TRUE(names(planned.report["steps"][1]["ended_by"].text(), {"waypoint", "path", "rest"}));
}

TEST(Mission, TheReportTheTerminalAndLianadAreToldWhichConditionEndedAStep) {
  const TemporaryFolder folder;
  const std::string mission = folder.write(
      "given.lua",
      "local liana = require 'liana'\n"
      "local function c(name, is) return liana.condition(name, function() return is end) end\n"
      "local function step(name) return liana.step(name) { device = 'none', time_limit_s = 5, on_fail = 'hold',\n"
      " exit = liana.all { c('a', true), liana.any { c('b', false), c('c', true), c('d', true) }, liana.at_rest() } } "
      "end\n"
      "return liana.mission 'given' { step 'one', step 'two' }\n");
  const MissionRun run = run_mission_against({}, mission, " --progress");
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  EXPECT_EQ(run.report["steps"][0]["ended_by"], "a and c and arm at rest");
  EXPECT_TRUE(names(run.ended.out, {"s", "a and c", "rest"}));
  ASSERT_EQ(run.ops("announce").size(), 3u);
  EXPECT_FALSE(Json::parse(run.ops("announce")[0]).contains("after"));
  EXPECT_EQ(Json::parse(run.ops("announce")[1])["after"], "a and c and arm at rest");
  EXPECT_EQ(Json::parse(run.ops("announce")[2])["after"], "a and c and arm at rest");
  EXPECT_EQ(Json::parse(run.ops("announce")[1])["step"]["entry"], 2);
}

// The runner looks at values only: it calls no function of the script before its time.
TEST(Mission, AFunctionOfAStepIsCalledOnceAndActionsSendWhatTheySay) {
  const TemporaryFolder folder;
  const std::string zeros = "{ 0, 0, 0, 0, 0, 0, 0, 0, 0, ";
  const MissionRun counted = run_mission_against(
      {}, one_step(folder,
                   "run = (function() local calls = 0 return function(arm) calls = calls + 1 arm.move_jp { "
                   "goal_deg = " +
                       zeros + "calls } } end end)(), exit = liana.at_rest(),"));
  ASSERT_EQ(counted.ops("move_jp").size(), 1u) << counted.ended.error;
  EXPECT_EQ(Json::parse(counted.ops("move_jp")[0])["goal_deg"][9], Json(1));
  const MissionRun said = run_mission_against(
      {},
      one_step(folder, "run = liana.move_jp { goal_deg = " + zeros + "2 }, rate_deg_s = 1 }, exit = liana.at_rest(),"));
  ASSERT_EQ(said.ops("move_jp").size(), 1u) << said.ended.error;
  EXPECT_EQ(Json::parse(said.ops("move_jp")[0])["rate_deg_s"], Json(1));
  const MissionRun tip = run_mission_against(
      {}, one_step(folder, "run = liana.move_cp { goal = { 3, 0, 0, 1, 0, 0, 0 } }, exit = liana.at_rest(),"));
  EXPECT_EQ(tip.ops("move_cp").size(), 1u) << tip.ended.error;
}

TEST(Mission, AWrongCommandNamesItsField) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {}, one_step(folder, "run = function(arm) arm.move_jp { goal = 1 } end, exit = liana.at_rest(),"));
  EXPECT_TRUE(names(run.ended.error, {"move_jp", "goal", "1", "goal_deg", "rate_deg_s"}));
  EXPECT_EQ(run.last_command(), "hold");
}

TEST(Mission, AnEndlessConditionIsStoppedByTheBudget) {
  const TemporaryFolder folder;
  const MissionRun run =
      run_mission_against({}, one_step(folder, "exit = liana.condition('never', function() while true do end end),"));
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_EQ(run.last_command(), "hold");
  EXPECT_NE(run.ended.error.find("computes too long"), std::string::npos) << run.ended.error;
}

// A loop no hook can stop: the process is killed, its socket closes (lianad holds), and the report still comes.
TEST(Mission, TheWatchdogKillsWhatTheBudgetCannotStop) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {}, one_step(folder,
                   "exit = liana.condition('never', function() xpcall(error, function() while true do end end) end),"));
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_TRUE(names(run.ended.error, {"given.lua", "2 s"}));
  EXPECT_NE(run.ended.error.find("given.lua:3"), std::string::npos) << run.ended.error;
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_EQ(run.report["mission"].get<std::string>().find("given") != std::string::npos, true);
}

// Nothing is left behind that could keep the socket, and with it ownership of motion.
TEST(Mission, KilledWithSignal9LeavesNoProcessThatOwnsMotion) {
  const TemporaryFolder folder;
  FakeLianad lianad(folder.file("api"), {.silent_in_step = 2});
  const std::string command = std::string(LIANA_MISSION) + " run --lockstep --api " + folder.file("api") +
                              " --mission slit_crossing & sleep 2; kill -9 $!";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(lianad.runner_left());
  EXPECT_EQ(lianad.requests().back()["op"], "announce");
}

TEST(Mission, WaitingForLianadIsNotComputing) {
  const MissionRun run = run_mission_against({.slow_in_step = 3});
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
}

TEST(Mission, AMemoryBombInAStepHolds) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against(
      {},
      one_step(folder, "run = function() local t = {} for i = 1, 1e9 do t[i] = {i} end end, exit = liana.at_rest(),"));
  EXPECT_EQ(run.ended.code, 1);
  EXPECT_TRUE(names(run.ended.error, {"memory"}));
  EXPECT_EQ(run.last_command(), "hold");
}

TEST(Mission, ABadMissionFileNeverReachesLianad) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against({}, folder.write("given.lua", "return {"));
  EXPECT_EQ(run.ended.code, 2);
  EXPECT_TRUE(run.requests.empty());
  EXPECT_NE(run.ended.error.find("given.lua:1:"), std::string::npos) << run.ended.error;
}

// Structure alone is known before lianad says which robot it serves.
TEST(Mission, OneThatTheRobotCannotDoIsRefusedBeforeItAsksForMotion) {
  const TemporaryFolder folder;
  const MissionRun run = run_mission_against({}, one_step(folder, "hold = { [11] = 0 }, exit = liana.at_rest(),"));
  EXPECT_EQ(run.ended.code, 2);
  ASSERT_EQ(run.requests.size(), 1u) << "hello alone";
  EXPECT_TRUE(names(run.ended.error, {"hold[11]", "held", "theta", "11", "1", "10"}));
}

// The mission reads like the experiment: steps 2 and 3 change places by moving text, and what step 2 makes planar stays
// so.
TEST(Mission, AShapeThatHasSettledEndsItsStepUnlessTooMuchIsMissing) {
  const TemporaryFolder folder;
  const std::string shape = "run = liana.shape { { node = 3, position_m = { 1, 0, 0 } } }, exit = liana.shape_settled";
  EXPECT_EQ(run_mission_against({}, one_step(folder, shape + "(),")).report["outcome"], "success");
  EXPECT_EQ(run_mission_against({}, one_step(folder, shape + "(0.02),")).report["outcome"], "success");
  const MissionRun run = run_mission_against({}, one_step(folder, shape + "(0.01),"));
  EXPECT_EQ(run.report["outcome"], "failed");
  EXPECT_TRUE(names(run.ended.error, {"shape", "0.01 m"}));
}

TEST(Mission, APlanIsOneMotionThroughAllItsWaypoints) {
  const TemporaryFolder folder;
  const std::string start = "[-8.5,0,-12,0,8,-2,13,0,12,-2]", next = "[-7.5,0,-12,0,8,-2,13,0,12,-1]",
                    far = "[0,0,0,0,0,0,0,0,0,0]";
  const auto plan = [&](const std::string& waypoints) {
    return folder.write("plan.json",
                        R"({"outcome":"solved","inputs":{"margin_m":0.004},"waypoints_deg":[)" + waypoints + "]}");
  };
  // Back where it began: the arm is at the last waypoint long before the path has ended.
  const std::string there_and_back = start + "," + next + "," + start;
  const MissionRun run = run_mission_against({}, plan(there_and_back));
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  const auto moves = run.ops("move_path");
  ASSERT_EQ(moves.size(), 1u);
  EXPECT_EQ(Json::parse(moves[0])["points_deg"], Json::parse("[" + there_and_back + "]"));
  EXPECT_EQ(Json::parse(moves[0])["margin_m"], 0.004);
  EXPECT_GT(run.report["duration_s"].get<double>(), 1.1) << "it has waited for the end of the path";
  const MissionRun elsewhere = run_mission_against({}, plan(far + "," + start));
  EXPECT_EQ(elsewhere.report["outcome"], "failed");
  EXPECT_TRUE(elsewhere.ops("move_path").empty());
  EXPECT_TRUE(names(elsewhere.ended.error, {"enter", "1 deg", "plan's start"}));
}

TEST(Mission, StepsRunInTheOrderInWhichTheyAreWritten) {
  const TemporaryFolder folder;
  std::string text = read_file(LIANA_SOURCE_DIR "/lua/missions/slit_crossing.lua");
  const auto third = text.find("step \"segment 5 goes");
  const auto second = text.find("step \"around the");
  const auto fourth = text.find("step \"segment 5 into");
  ASSERT_LT(second, third);
  text = text.substr(0, second) + text.substr(third, fourth - third) + text.substr(second, third - second) +
         text.substr(fourth);
  const MissionRun run = run_mission_against({}, folder.write("swapped.lua", text));
  EXPECT_EQ(run.report["outcome"], "success") << run.ended.error;
  EXPECT_EQ(run.report["steps"][1]["name"], "segment 5 goes planar");
  EXPECT_EQ(run.report["steps"][2]["device"], "vr");
  EXPECT_EQ(run.report["steps"][2]["held_theta"], Json({9}));
}

}  // namespace
}  // namespace liana::mission_runner
