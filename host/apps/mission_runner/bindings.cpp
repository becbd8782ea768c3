#include "host/apps/mission_runner/bindings.hpp"

#include <array>
#include <exception>
#include <stdexcept>

#include "host/api/server/request_check.hpp"
#include "host/api/server/request_error.hpp"
#include "host/apps/mission_runner/activity.hpp"
#include "host/apps/mission_runner/json_bridge.hpp"
#include "host/apps/mission_runner/script.hpp"
#include "host/base/json/json.hpp"
#include "host/control/force_control/requests.hpp"

namespace liana::mission_runner {
namespace {

constexpr std::size_t kFirst = 1;  // Lua counts from 1

// Runs `body` and turns its exception into a Lua error after every C++ object is gone.
template <typename Body>
int guarded(lua_State* state, const Body& body) {
  std::array<char, 400> problem{};
  try {
    return body();
  } catch (const std::exception& error) {
    put_text(problem, error.what());
  }
  luaL_where(state, 1);
  lua_pushstring(state, problem.data());
  lua_concat(state, 2);
  return lua_error(state);
}

RequestSink& sink_of(lua_State* state) {
  return *static_cast<RequestSink*>(lua_touserdata(state, lua_upvalueindex(1)));
}

// The table of fields at `index`; an empty one is an array to to_json.
Json fields_at(lua_State* state, int index, const api::RequestRow& row) {
  Json fields = lua_isnoneornil(state, index) ? Json::object() : to_json(state, index, row.op);
  if (fields.is_array() && fields.empty()) fields = Json::object();
  if (!fields.is_object())
    throw api::RequestError("bad_request",
                            std::string("allowed a table with named fields: write arm.") + row.op + " { ... }");
  return fields;
}

// Names and types are the script's own business; what the robot allows, lianad says.
int send_command(lua_State* state) {
  const auto& row = *static_cast<const api::RequestRow*>(lua_touserdata(state, lua_upvalueindex(2)));
  return guarded(state, [&] {
    try {
      Json fields = fields_at(state, 1, row);
      api::check_fields(row, fields, nullptr, kFirst);
      lua_pushinteger(state, sink_of(state).request(row, std::move(fields)));
      return 1;
    } catch (const api::RequestError& error) {
      throw std::runtime_error(std::string(row.op) + ": " + error.what());
    }
  });
}

// What is refused is the result and no error; the text is copied so that no C++ object is left when Lua raises one.
int refusal(lua_State* state) {
  const auto& robot = *static_cast<const RobotAtHand*>(lua_touserdata(state, lua_upvalueindex(1)));
  std::array<char, 400> problem{};
  try {
    const char* op = lua_tostring(state, 1);
    const api::RequestRow& row = api::row_of({{"op", op != nullptr ? op : ""}});
    api::require_may(row, api::Role::kMission, robot.bounds);
    const Json fields = fields_at(state, 2, row);
    api::check_fields(row, fields, &robot.bounds, kFirst);
    const api::Arguments asked{fields, row.fields, robot.bounds};
    if (robot.serial) {
      force_control::require_possible(*robot.serial, row.op, asked);
    } else if (std::string_view(row.op) == "payload") {
      force_control::tip_load_of(asked);
    }
  } catch (const std::exception& error) {
    put_text(problem, error.what());
  }
  if (problem[0] == '\0') return 0;
  lua_pushstring(state, problem.data());
  return 1;
}

int send_progress(lua_State* state) {
  return guarded(state, [&] {
    sink_of(state).progress(to_json(state, 1, "progress"));
    return 0;
  });
}

int send_report(lua_State* state) {
  return guarded(state, [&] {
    sink_of(state).report(to_json(state, 1, "report"));
    return 0;
  });
}

// (request) -> the plan, see follow_plan.hpp; what is wrong with the curve is an error.
int plan_curve(lua_State* state) {
  const Json* plan = nullptr;
  guarded(state, [&] {
    plan = &sink_of(state).plan_curve(to_json(state, 1, "follow_curve"));
    return 0;
  });
  push_json(state, *plan);
  return 1;
}

void add_native(lua_State* state, RequestSink& sink, const char* name, lua_CFunction function) {
  lua_pushlightuserdata(state, &sink);
  lua_pushcclosure(state, function, 1);
  lua_setfield(state, -2, name);
}

}  // namespace

std::vector<const api::RequestRow*> commands() {
  std::vector<const api::RequestRow*> out;
  for (const api::RequestRow& row : api::request_table()) {
    if (row.in_missions) out.push_back(&row);
  }
  return out;
}

void push_refusal(lua_State* state, const RobotAtHand& robot) {
  lua_pushlightuserdata(state, const_cast<RobotAtHand*>(&robot));
  lua_pushcclosure(state, refusal, 1);
}

void push_native(lua_State* state, RequestSink& sink) {
  lua_newtable(state);
  lua_newtable(state);
  for (const api::RequestRow* row : commands()) {
    lua_pushlightuserdata(state, &sink);
    lua_pushlightuserdata(state, const_cast<api::RequestRow*>(row));
    lua_pushcclosure(state, send_command, 2);
    lua_setfield(state, -2, row->op);
  }
  lua_setfield(state, -2, "commands");
  add_native(state, sink, "progress", send_progress);
  add_native(state, sink, "report", send_report);
  add_native(state, sink, "plan_curve", plan_curve);
  lua_pushcfunction(state, attempt);
  lua_setfield(state, -2, "attempt");
}

}  // namespace liana::mission_runner
