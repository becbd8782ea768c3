#include <gtest/gtest.h>

#include "host/apps/mission_runner/bindings.hpp"
#include "host/base/json/json.hpp"
#include "tests/lua/program.hpp"
#include "tests/message.hpp"

namespace liana::mission_runner {
namespace {

TEST(Bindings, PrintAsJsonForTools) {
  const Ended ended = run_program("bindings");
  ASSERT_EQ(ended.code, 0);
  EXPECT_EQ(Json::parse(ended.out).size(), commands().size());
}

// Calls the command as a script would and returns what it raises.
std::string raised_by(const std::string& call) {
  struct Sink : RequestSink {
    std::int64_t request(const api::RequestRow&, Json) override { return 1; }
    void progress(const Json&) override {}
    void report(const Json&) override {}
    const Json& plan_curve(const Json& curve) override { return curve; }
  } sink;
  lua_State* state = luaL_newstate();
  push_native(state, sink);
  lua_getfield(state, -1, "commands");
  lua_setglobal(state, "arm");
  const bool failed = luaL_dostring(state, call.c_str()) != 0;
  const std::string text = failed ? lua_tostring(state, -1) : "";
  lua_close(state);
  return text;
}

TEST(Bindings, RefuseFieldsOfOtherTypesAndNamesAtTheLineOfTheScript) {
  EXPECT_EQ(raised_by("arm.move_jp { goal_deg = { 0, 1.5 } }"), "") << "how many angles there are, lianad knows";
  EXPECT_EQ(raised_by("arm.hold()"), "");
  EXPECT_EQ(raised_by("arm.announce {}"), "");
  const auto raises = [](const char* call, const Facts& facts) { EXPECT_TRUE(names(raised_by(call), facts)) << call; };
  raises("\narm.move_jp {}", {":2", "move_jp", "goal_deg", "missing"});
  raises("arm.move_jp { goal_deg = { 'a' } }", {"move_jp", "goal_deg[1]", "a", "number"});
  raises("arm.use_device { device = 'vr', node = 1.5 }", {"use_device", "node", "1.5", "whole"});
  raises("arm.hold { now = true }", {"hold", "unknown", "now", "true"});
  raises("arm.hold { 1 }", {"hold", "arm.hold", "fields"});
}

}  // namespace
}  // namespace liana::mission_runner
