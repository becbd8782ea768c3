#include "host/operator/terminal/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>

#include "host/operator/terminal/state_text.hpp"
#include "tests/message.hpp"

namespace liana::terminal {
namespace {

Json welcome() {
  return {{"robot", {{"name", "zhu2022"}, {"limits", {{"tip_speed_m_s", 0.1}, {"tip_rate_deg_s", 10.0}}}}}};
}

Json state(const std::string& owner = "me", const std::string& phase = "ENABLED") {
  return {{"op", "state"},
          {"time_s", 12.5},
          {"state", phase},
          {"owner", owner},
          {"at_rest", true},
          {"setpoint_cp", {1.0, 0.2, 0.3, 1.0, 0.0, 0.0, 0.0}},
          {"measured_cp", {1.0, 0.2, 0.301, 1.0, 0.0, 0.0, 0.0}},
          {"tension_N", {30.0, 120.0, 60.0}},
          {"stop", nullptr},
          {"faults", Json::array()},
          {"limits", {"theta_rate"}},
          {"ik", {{"outcome", "converged"}}},
          {"verdict", {{"released", false}, {"code", 0}, {"text", ""}}},
          {"contact", {{"segment", 3}, {"on_body", true}, {"force_N", {0.0, 3.0, 4.0}}}},
          {"clearance", {{"distance_m", 0.0142}, {"bound_m", 0.0034}, {"body", "wall"}, {"level", "free"}}}};
}

Session session_at(const Json& said) {
  Session session("me", welcome(), 1.0);
  session.hear(said, 1.0);
  return session;
}

std::string text_of(const Session& session, double now_s = 1.0) {
  std::string text;
  for (const std::string& line : session.lines({.columns = 200, .rows = 50}, now_s)) text += line + "\n";
  return text;
}

// req:A16
TEST(TeleopSession, AGamepadThatLeansIsAStreamOfGoalsAndLettingItGoIsOneHold) {
  Session session = session_at(state());
  session.lean(Direction{{0.0, 0.5, 0.0}, {}});
  double last_m = 0.2;
  for (double now_s = 1.0; now_s < 2.0; now_s += Session::kPeriod_s) {
    session.hear(state(), now_s);
    const auto requests = session.pass(now_s);
    ASSERT_EQ(requests.size(), 1U);
    ASSERT_EQ(requests[0].at("op"), "servo_cp");
    last_m = requests[0].at("goal")[1].get<double>();
  }
  EXPECT_NEAR(last_m, 0.2 + 0.5 * 0.03, 1e-3);
  session.lean(std::nullopt);
  const auto after = session.pass(2.1);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].at("op"), "hold");
  EXPECT_TRUE(session.pass(2.2).empty());
}

TEST(TeleopSession, AGamepadThatLeansWithoutMotionSaysWhyNothingMoves) {
  Session session = session_at(state("somebody"));
  session.lean(Direction{{1.0, 0.0, 0.0}, {}});
  EXPECT_TRUE(session.pass(1.0).empty());
  EXPECT_TRUE(names(text_of(session), {"take motion"}));
}

// req:A16
TEST(TeleopSession, AHeldKeyIsAStreamOfGoalsAndLettingItGoIsOneHold) {
  Session session = session_at(state());
  EXPECT_TRUE(session.press(*key_of('w'), 1.0).empty());
  double last_m = 1.0;
  for (double now_s = 1.0; now_s < 1.14; now_s += Session::kPeriod_s) {
    const auto requests = session.pass(now_s);
    ASSERT_EQ(requests.size(), 1U);
    EXPECT_EQ(requests[0].at("op"), "servo_cp");
    EXPECT_EQ(requests[0].at("ttl_s"), Session::kTimeToLive_s);
    const double next_m = requests[0].at("goal")[0].get<double>();
    EXPECT_GE(next_m, last_m);
    last_m = next_m;
  }
  EXPECT_GT(last_m, 1.003);
  const auto after = session.pass(1.2);
  ASSERT_EQ(after.size(), 1U);
  EXPECT_EQ(after[0].at("op"), "hold");
  EXPECT_TRUE(session.pass(1.3).empty());
}

TEST(TeleopSession, KeysMoveNothingWithoutMotionOrBeforeTheArmIsEnabled) {
  for (const Json& said : {state("somebody"), state("me", "DISABLED"), Json{{"op", "state"}}}) {
    Session session = session_at(said);
    session.press(*key_of('w'), 1.0);
    EXPECT_TRUE(session.pass(1.0).empty());
    EXPECT_NE(text_of(session).find("nothing moves before"), std::string::npos);
  }
}

TEST(TeleopSession, AStopIsAskedForAtOnceWhoeverOwnsMotionAndEndsTheJog) {
  Session session = session_at(state());
  session.press(*key_of('w'), 1.0);
  ASSERT_FALSE(session.pass(1.0).empty());
  const auto stop = session.press(*key_of(' '), 1.01);
  ASSERT_EQ(stop.size(), 1U);
  EXPECT_EQ(stop[0].at("op"), "stop");
  EXPECT_TRUE(session.pass(1.02).empty());
  EXPECT_EQ(session_at(state("somebody")).press(*key_of('\x1b'), 0.0)[0].at("op"), "stop");
}

TEST(TeleopSession, WhatLianadRefusesIsSaidAndTheNextGoalBeginsAtTheCommandedTip) {
  Session session = session_at(state());
  session.press(*key_of('w'), 1.0);
  for (int k = 0; k < 8; ++k) session.pass(1.0 + k * Session::kPeriod_s);
  session.hear({{"op", "error"}, {"id", 1}, {"code", "refused"}, {"message", "too near the wall"}}, 1.1);
  EXPECT_NE(text_of(session).find("too near the wall"), std::string::npos);
  const auto next = session.pass(1.14);
  ASSERT_EQ(next.size(), 1U);
  EXPECT_EQ(next[0].at("goal")[0].get<double>(), 1.0);
}

// req:A24
TEST(TeleopSession, LinesSayStateOwnerClearanceForceAndWhatIsWrong) {
  const std::string fine = text_of(session_at(state()));
  for (const char* word : {"zhu2022", "ENABLED", "motion is yours", "14.2 mm to wall", "30 to 120 N", "5.0 N",
                           "segment 3", "theta_rate", "converged", "1.0 mm"})
    EXPECT_NE(fine.find(word), std::string::npos) << word << " in\n" << fine;
  EXPECT_EQ(fine.find("REFUSED"), std::string::npos) << "nothing was asked yet";
  Json bad = state("pilot", "FAULT");
  bad["faults"] = {{{"number", 3002}, {"name", "drive_silent"}, {"remedy", "Check the supply."}}};
  bad["faults"][0]["where"] = "drive 4 (node 4, segment 2)";
  bad["stop"] = {{"by", "anna"}, {"reason", "smoke\x1b[2J"}};
  bad["verdict"] = {{"released", false}, {"code", 104}, {"text", "angle limit"}, {"remedy", "go back"}};
  const std::string wrong = text_of(session_at(bad));
  for (const char* word : {"motion belongs to pilot", "3002 drive_silent", "drive 4 (node 4, segment 2)",
                           "Check the supply.", "by anna: smoke", "angle limit: go back"})
    EXPECT_NE(wrong.find(word), std::string::npos) << word << " in\n" << wrong;
  EXPECT_EQ(wrong.find('\x1b'), std::string::npos) << "texts of others move no cursor";
}

// req:A24
TEST(TeleopSession, EverythingFitsATerminalOf80By24AndItsLastLineSaysHowToQuit) {
  Json bad = state("pilot", "FAULT");
  for (int number = 3001; number < 3020; ++number)
    bad["faults"].push_back({{"number", number}, {"name", "drive_silent"}, {"remedy", std::string(150, 'a') + " b"}});
  Session session = session_at(bad);
  session.say(std::string(100, 'x') + " " + std::string(300, 'y'));
  session.press(*key_of(' '), 1.0);
  bad["not_homed"] = {{"reason", "lengths_contradict"}, {"text", "cables 1 to 3"}};
  for (const auto& [shown, now_s] : {std::pair(state(), 1.0), {bad, 1.0}, {bad, 1000.0}}) {
    session.hear(shown, 1.0);
    const std::vector<std::string> lines = session.lines({}, now_s);
    EXPECT_LE(lines.size(), 24U);
    for (const std::string& line : lines) EXPECT_LE(line.size(), 80U) << line;
    EXPECT_NE(lines.back().find("Ctrl-C"), std::string::npos);
  }
  EXPECT_NE(text_of(session).find("3001"), std::string::npos);
}

TEST(TeleopSession, ALianadThatSaysNothingForASecondIsShownAsNotLiveAndGetsOneStopAndNothingElse) {
  Session session = session_at(state());
  session.press(*key_of('w'), 1.9);
  ASSERT_FALSE(session.pass(1.9).empty());
  EXPECT_EQ(text_of(session, 1.9).find("NOT LIVE"), std::string::npos);
  EXPECT_TRUE(names(text_of(session, 2.1), {"NOT LIVE", "1.1 s", "ENABLED"}));
  EXPECT_EQ(text_of(session, 2.1).find("at rest"), std::string::npos) << "nobody knows";
  session.lean(Direction{{1.0, 0.0, 0.0}, {}});
  for (const char key : {'w', 't', 'n', 'b', 'c', 'r', 'h'}) EXPECT_TRUE(session.press(*key_of(key), 2.1).empty());
  EXPECT_TRUE(session.pass(2.1).empty());
  EXPECT_EQ(session.press(*key_of(' '), 2.2).size(), 1U);
  EXPECT_TRUE(session.press(*key_of(' '), 2.3).empty()) << "the first one waits in lianad's socket";
  session.hear(state(), 9.0);
  EXPECT_EQ(text_of(session, 9.5).find("NOT LIVE"), std::string::npos);
  EXPECT_EQ(session.press(*key_of('n'), 9.5).size(), 1U);
}

TEST(TeleopSession, InFastTimeALianadThatWaitsForOthersIsLive) {
  Json fast = welcome();
  fast["time_mode"] = "fast";
  Session session("me", fast, 1.0);
  session.hear(state(), 1.0);
  EXPECT_EQ(text_of(session, 9.0).find("NOT LIVE"), std::string::npos);
  EXPECT_EQ(session.press(*key_of('n'), 9.0).size(), 1U);
}

TEST(TeleopSession, AStopThatIsNotConfirmedWithinASecondSaysSoUntilItIs) {
  Session session = session_at(state());
  session.press(*key_of(' '), 1.0);
  const int id = session.press(*key_of(' '), 1.5)[0].at("id").get<int>();
  EXPECT_EQ(text_of(session, 1.9).find("NOT STOPPED"), std::string::npos);
  session.hear(state(), 2.0);
  EXPECT_TRUE(names(text_of(session, 2.1), {"NOT STOPPED", "1.1 s", "cut the power"})) << "counted from the first one";
  session.hear({{"op", "ok"}, {"id", id - 1}}, 2.2);
  EXPECT_NE(text_of(session, 2.2).find("NOT STOPPED"), std::string::npos) << "the answer to something else";
  session.hear({{"op", "ok"}, {"id", id}}, 2.3);
  EXPECT_EQ(text_of(session, 2.3).find("NOT STOPPED"), std::string::npos);
}

TEST(TeleopSession, TheSecondPressTakesMotionByNameFromTheOwnerThatTheRefusalNames) {
  Session session = session_at(state("pilot"));
  const Json first = session.press(*key_of('t'), 1.0)[0];
  EXPECT_FALSE(first.contains("from"));
  const Json refusal{
      {"op", "error"}, {"id", first.at("id")}, {"code", "not_owner"}, {"message", "'pilot' (acquire with from)"}};
  session.hear(refusal, 1.1);
  EXPECT_TRUE(names(text_of(session, 1.1), {"pilot", "press t again"}));
  EXPECT_EQ(session.press(*key_of('t'), 1.2)[0].at("from"), "pilot");
  session.hear(state("other"), 1.3);
  EXPECT_FALSE(session.press(*key_of('t'), 1.3)[0].contains("from")) << "of this owner nothing was said";
}

TEST(TeleopSession, MotionIsTakenByNameOnlyRightAfterTheRefusal) {
  Session session = session_at(state("pilot"));
  const Json refusal{{"op", "error"}, {"id", 1}, {"code", "not_owner"}, {"message", "'pilot'"}};
  session.press(*key_of('t'), 1.0);
  session.hear(refusal, 1.0);
  session.press(*key_of('h'), 1.1);
  EXPECT_FALSE(session.press(*key_of('t'), 1.2)[0].contains("from")) << "another key came between";
  session.hear(refusal, 1.2);
  EXPECT_FALSE(session.press(*key_of('t'), 1.3)[0].contains("from")) << "the answer to something else";
}

TEST(TeleopSession, AnArmThatGoesBackShowsWhatIsLeftOfThePathHereAndInItsState) {
  Json back = state();
  back["retract"] = {{"phase", "back"}, {"points_left", 21}, {"points", 50}, {"reason", ""}};
  EXPECT_TRUE(names(text_of(session_at(back)), {"RETRACT", "back", "42 %", "21 of 50"}));
  EXPECT_TRUE(names(state_text(back), {"retract: ", "back", "42 %", "21 of 50"}));
  for (const char* over : {"none", "done", "ended"}) {
    back["retract"]["phase"] = over;
    EXPECT_EQ(text_of(session_at(back)).find("RETRACT"), std::string::npos) << over;
    EXPECT_EQ(state_text(back).find("retract: "), std::string::npos) << over;
  }
}

TEST(TeleopSession, AnArmThatIsNotHomedIsShownWithTheReasonAndIsNotSaidToEnable) {
  Json unhomed = state("me", "DISABLED");
  EXPECT_TRUE(names(text_of(session_at(unhomed)), {"n enables"}));
  unhomed["not_homed"] = {{"reason", "lengths_contradict"}, {"text", "cables 1 to 3"}};
  const std::string text = text_of(session_at(unhomed));
  EXPECT_TRUE(names(text, {"NOT HOMED", "cables 1 to 3", "lengths_contradict"}));
  EXPECT_EQ(text.find("n enables"), std::string::npos);
}

TEST(TeleopSession, WhatWasSaidGoesWithTheNextRequestAndAStopWithoutReasonEndsWithItsName) {
  Json stopped = state("me", "DISABLED");
  stopped["stop"] = {{"by", "liana estop"}, {"reason", ""}};
  Session session = session_at(stopped);
  session.hear({{"op", "event"}, {"kind", "retract"}, {"text", "retract refused"}}, 1.0);
  EXPECT_NE(text_of(session).find("retract refused"), std::string::npos);
  EXPECT_NE(text_of(session).find("by liana estop\n"), std::string::npos);
  session.press(*key_of('c'), 1.1);
  EXPECT_EQ(text_of(session).find("retract refused"), std::string::npos);
}

TEST(StateText, NamesStopReasonDeviceFaultWithRemedyAndWhyTheArmIsNotHomed) {
  Json bad = state("", "DISABLED");
  EXPECT_EQ(state_text(bad).find("device"), std::string::npos) << "none leads";
  bad["stop"] = {{"by", "anna"}, {"reason", "smoke"}};
  bad["faults"] = {{{"number", 3002}, {"name", "drive_silent"}, {"text", "It fell silent."}, {"remedy", "Check it."}}};
  bad["not_homed"] = {{"reason", "lengths_contradict"}, {"text", "cables 1 to 3"}};
  bad["device"] = "omega";
  bad["device_engaged"] = false;
  bad["device_reason"] = "device silent";
  bad["device_rate"] = {{"hz", 90.0}};
  const std::string text = state_text(bad);
  for (const char* words : {"owner nobody", "emergency stop by anna: smoke\n", "3002 drive_silent", "It fell silent.",
                            "Check it.", "not homed: ", "device omega", "device silent", "90.0 samples/s"})
    EXPECT_NE(text.find(words), std::string::npos) << words << " in\n" << text;
  bad["stop"]["reason"] = "";
  bad["state"] = "BOOTING";
  bad["device_reason"] = "";
  bad["device_engaged"] = true;
  EXPECT_NE(state_text(bad).find("by anna\n"), std::string::npos);
  EXPECT_EQ(state_text(bad).find("not homed"), std::string::npos) << "nobody has looked yet";
  EXPECT_TRUE(names(state_text(bad), {"omega", "90.0", "engaged"}));
}

TEST(TeleopSession, NoLineIsLongerThanTheTerminalIsWideAndBeforeTheFirstStateThereAreSome) {
  for (const std::string& line : session_at(state()).lines({.columns = 20, .rows = 24}, 1.0))
    EXPECT_LE(line.size(), 20U);
  EXPECT_NE(text_of(Session("me", welcome(), 1.0)).find("no state yet"), std::string::npos);
}

TEST(TeleopSession, SpeedStaysWithinTheRobotsLimits) {
  Session session = session_at(state());
  for (int k = 0; k < 50; ++k) session.press(*key_of('+'), 0.0);
  EXPECT_NE(text_of(session).find("100 mm/s, 10.0 deg/s"), std::string::npos) << text_of(session);
  for (int k = 0; k < 100; ++k) session.press(*key_of('-'), 0.0);
  EXPECT_NE(text_of(session).find("1 mm/s, 0.3 deg/s"), std::string::npos) << text_of(session);
}

}  // namespace
}  // namespace liana::terminal
