#include "host/operator/terminal/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
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
  Session session("me", welcome());
  session.hear(said);
  return session;
}

std::string text_of(const Session& session) {
  std::string text;
  for (const std::string& line : session.lines({.columns = 200, .rows = 50})) text += line + "\n";
  return text;
}

// req:A16
TEST(TeleopSession, AGamepadThatLeansIsAStreamOfGoalsAndLettingItGoIsOneHold) {
  Session session = session_at(state());
  session.lean(Direction{{0.0, 0.5, 0.0}, {}});
  double last_m = 0.2;
  for (double now_s = 1.0; now_s < 2.0; now_s += Session::kPeriod_s) {
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
  session.hear({{"op", "error"}, {"id", 1}, {"code", "refused"}, {"message", "too near the wall"}});
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
  for (const Json& shown : {state(), bad}) {
    session.hear(shown);
    const std::vector<std::string> lines = session.lines({});
    EXPECT_LE(lines.size(), 24U);
    for (const std::string& line : lines) EXPECT_LE(line.size(), 80U) << line;
    EXPECT_NE(lines.back().find("Ctrl-C"), std::string::npos);
  }
  EXPECT_NE(text_of(session).find("3001"), std::string::npos);
}

TEST(TeleopSession, NoLineIsLongerThanTheTerminalIsWideAndBeforeTheFirstStateThereAreSome) {
  for (const std::string& line : session_at(state()).lines({.columns = 20, .rows = 24})) EXPECT_LE(line.size(), 20U);
  EXPECT_NE(text_of(Session("me", welcome())).find("no state yet"), std::string::npos);
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
