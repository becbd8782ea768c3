// Conditions of missions, asked about states that are written out.
#include <gtest/gtest.h>

#include "host/apps/mission_runner/json_bridge.hpp"
#include "host/apps/mission_runner/script.hpp"
#include "host/base/json/json.hpp"
#include "tests/message.hpp"

namespace liana::mission_runner {
namespace {

// What `condition` answers about an arm whose state is `state`: { is it met, what of it }.
Json asked(const std::string& condition, const std::string& state) {
  Activity activity;
  Script script(ScriptLimits{}, LIANA_SOURCE_DIR "/lua", activity);
  script.run({"condition_test.lua", "local liana = require 'liana'\nlocal met, what = " + condition +
                                        ".met { state = " + state + " }\nreturn { met or false, what or '' }"});
  return to_json(script.state(), -1, "condition_test.lua");
}

std::string servo(const std::string& phase) { return "{ servo = { phase = '" + phase + "', reason = 'not seen' } }"; }

// req:B16
TEST(Conditions, OfTheServoTellArrivalFromEveryOtherPhaseAndSayWhyItFailed) {
  const char* const phases[] = {"standby", "approaching", "dwelling", "done", "lost", "timed_out"};
  for (const std::string phase : phases) {
    EXPECT_EQ(asked("liana.servo_done()", servo(phase))[0].get<bool>(), phase == "done") << phase;
    EXPECT_EQ(asked("liana.servo_failed()", servo(phase))[0].get<bool>(), phase == "lost" || phase == "timed_out")
        << phase;
  }
  EXPECT_EQ(asked("liana.servo_failed()", servo("lost"))[1].text(), "target lost: not seen");
  EXPECT_TRUE(names(asked("liana.servo_failed()", servo("timed_out"))[1].text(), {"servo", "timed out", "not seen"}));
}

// At the goal of the step's last motion, of joints and of the tip, and one step beside the tolerance.
TEST(Conditions, GoalReachedIsMetAtRestAtTheGoalOfTheLastMotionAlone) {
  const auto met = [](const std::string& goal, const std::string& more, const std::string& joint,
                      const std::string& tip) {
    return asked("liana.goal_reached()", "{ at_rest = true, is_busy = false" + more + ", setpoint_js_deg = { 1, " +
                                             joint + " }, setpoint_cp = { 0.5, 0, " + tip +
                                             ", 1, 0, 0, 0 } }, goal = " + goal)[0]
        .get<bool>();
  };
  const std::string joints = "{ joints_deg = { 1, 2 } }", tip = "{ tip = { 0.5, 0, 1, -1, 0, 0, 0 } }";
  EXPECT_TRUE(met(joints, "", "2.0199", "7"));
  EXPECT_FALSE(met(joints, "", "2.0201", "7"));
  EXPECT_TRUE(met(tip, "", "9", "1.00099"));
  EXPECT_FALSE(met(tip, "", "9", "1.00101"));
  EXPECT_FALSE(met("{ tip = { 0.5, 0, 1, 0.999999, 0.0015, 0, 0 } }", "", "9", "1")) << "turned by 0.17 deg";
  EXPECT_FALSE(met("nil", "", "2", "1")) << "without a motion";
  for (const char* more : {", is_busy = true", ", at_rest = false", ", path = {}"})
    EXPECT_FALSE(met(joints, more, "2", "1")) << more;
}

TEST(Conditions, OfAShapeSayThatAnArmHasNone) {
  EXPECT_TRUE(asked("liana.shape_settled()", "{ shape = { settled = true, missing_m = 0 } }")[0].get<bool>());
  try {
    asked("liana.shape_settled()", "{}");
    FAIL() << "an arm without a shape was asked";
  } catch (const std::exception& error) {
    EXPECT_TRUE(names(error.what(), {"shape_settled", "shape"}));
  }
}

}  // namespace
}  // namespace liana::mission_runner
