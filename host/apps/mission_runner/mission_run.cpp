#include "host/apps/mission_runner/mission_run.hpp"

#include <cstdio>
#include <exception>

#include "host/apps/mission_runner/evaluate.hpp"
#include "host/apps/mission_runner/json_bridge.hpp"
#include "host/apps/mission_runner/session.hpp"
#include "host/base/json/json.hpp"

namespace liana::mission_runner {
namespace {

constexpr const char* kClientName = "mission";  // as said in hello; lianad's state names the owner so
constexpr int kLastMessages = 20;               // each waited for half a second at most

int push_native_protected(lua_State* state) {
  push_native(state, *static_cast<RequestSink*>(lua_touserdata(state, 1)));
  return 1;
}

// Leaves engine.new(mission, welcome, native, name, is_rehearsal) on the stack; the mission is on top before.
void start_engine(Script& script, MissionSession& session, bool is_rehearsal) {
  lua_State* state = script.state();
  script.require("liana.engine");
  lua_getfield(state, -1, "new");
  lua_pushvalue(state, -3);
  push_in_protection(script, session.welcome());
  lua_pushcfunction(state, push_native_protected);
  lua_pushlightuserdata(state, static_cast<RequestSink*>(&session));
  script.call(1, 1);
  lua_pushstring(state, kClientName);
  lua_pushboolean(state, is_rehearsal ? 1 : 0);
  script.call(5, 1);
}

// runner:method(message); true when it returns true. The runner is on top.
bool tell_engine(Script& script, const char* method, const Json& message) {
  lua_State* state = script.state();
  lua_getfield(state, -1, method);
  lua_pushvalue(state, -2);
  push_in_protection(script, message);
  script.call(2, 1);
  const bool over = lua_toboolean(state, -1) != 0;
  lua_pop(state, 1);
  return over;
}

// Messages in, commands out, until the engine says that the mission is over.
void converse(Script& script, MissionSession& session) {
  bool over = false;
  while (!over) {
    const Json message = session.next();
    if (!message.is_object()) continue;
    const std::string op = message.value("op", "");
    if (op == "ok" || op == "error") tell_engine(script, "on_answer", message);
    if (op != "state") continue;
    over = tell_engine(script, "on_state", message);
    session.done(message.value("tick", std::int64_t{0}));
  }
}

// The socket stays open until the answers to the last commands are through. In lockstep time lianad would otherwise
// notice this end in the present interval or in the next one, as it happens, and runs would not repeat.
void await_next_state(MissionSession& session) {
  try {
    for (int i = 0; i < kLastMessages; ++i) {
      const Json message = session.next();
      if (message.is_object() && message.value("op", "") == "state") return;
    }
  } catch (const std::exception&) {
    // lianad is gone: nothing will come
  }
}

void finish(const MissionOptions& options, const std::string& report) {
  if (!options.report_file.empty()) write_report(options.report_file, report);
  if (options.json) std::printf("%s\n", report.c_str());
}

int run_connected(const MissionOptions& options, Activity& activity, Script& script) {
  MissionSession session(options, activity);
  const Json& welcome = session.welcome();
  check_against_robot(script, {welcome.at("robot"), welcome.member_or_null("buses")}, Looks::kAtValues);
  try {
    start_engine(script, session, options.rehearsal);
    converse(script, session);
    if (options.lockstep) await_next_state(session);
  } catch (const std::exception& error) {
    session.hold_quietly();
    std::fprintf(stderr, "liana-mission: %s: %s\n", options.mission.c_str(), error.what());
    finish(options, failed_report(activity, options.mission, error.what()));
    return kExitNotSuccess;
  }
  const Json report = session.last_report();
  finish(options, report.dump());
  if (report.value("outcome", "") == "success") return kExitSuccess;
  std::fprintf(stderr, "liana-mission: %s: %s: %s\n", options.mission.c_str(), report.value("outcome", "").c_str(),
               report.value("reason", "").c_str());
  return kExitNotSuccess;
}

}  // namespace

int run_mission(const MissionOptions& options, Activity& activity) {
  Script script(ScriptLimits{}, options.lua_folders, activity);
  load_mission(script, options.lua_folders, options.mission);
  return run_connected(options, activity, script);
}

}  // namespace liana::mission_runner
