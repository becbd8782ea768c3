#include "host/lua/bindings.hpp"

#include <array>
#include <exception>
#include <stdexcept>

#include "host/json/json.hpp"
#include "host/lua/activity.hpp"
#include "host/lua/json_bridge.hpp"

namespace liana {
namespace {

constexpr std::array<BindingField, 1> kStateCommand = {{{"command", "string", true}}};
constexpr std::array<BindingField, 2> kMoveJp = {{{"goal_deg", "number[]", true}, {"rate_deg_s", "number", false}}};
constexpr std::array<BindingField, 2> kMoveCp = {{{"goal", "number[]", true}, {"hold", "table[]", false}}};
constexpr std::array<BindingField, 1> kServoCp = {{{"goal", "number[]", true}}};
constexpr std::array<BindingField, 1> kHoldTheta = {{{"held", "table[]", true}}};
constexpr std::array<BindingField, 3> kShape = {
    {{"nodes", "table[]", true}, {"keep_clear", "table[]", false}, {"search", "boolean", false}}};
constexpr std::array<BindingField, 5> kUseDevice = {{{"device", "string", true},
                                                     {"scale", "number", false},
                                                     {"rotation_scale", "number", false},
                                                     {"node", "integer", false},
                                                     {"speed_m_s", "number", false}}};
constexpr std::array<BindingField, 1> kRetract = {{{"until_tick", "integer", false}}};
constexpr std::array<BindingField, 1> kTool = {{{"command", "string", true}}};
constexpr std::array<BindingField, 1> kStop = {{{"reason", "string", true}}};
constexpr std::array<BindingField, 1> kAnnounce = {{{"step", "table", false}}};

constexpr std::array<Binding, 14> kBindings = {{{"acquire", {}},
                                                {"release", {}},
                                                {"state_command", kStateCommand},
                                                {"move_jp", kMoveJp},
                                                {"move_cp", kMoveCp},
                                                {"servo_cp", kServoCp},
                                                {"hold_theta", kHoldTheta},
                                                {"shape", kShape},
                                                {"use_device", kUseDevice},
                                                {"retract", kRetract},
                                                {"hold", {}},
                                                {"tool", kTool},
                                                {"stop", kStop},
                                                {"announce", kAnnounce}}};

bool has_type(const Json& value, const std::string& type) {
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  if (type == "boolean") return value.is_boolean();
  if (type == "string") return value.is_string();
  if (type == "table") return value.is_object();
  if (!value.is_array()) return false;
  const std::string element = type.substr(0, type.size() - 2);  // "number[]"
  for (const auto& each : value) {
    if (!has_type(each, element)) return false;
  }
  return true;
}

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

int send_command(lua_State* state) {
  const auto& binding = *static_cast<const Binding*>(lua_touserdata(state, lua_upvalueindex(2)));
  return guarded(state, [&] {
    Json fields = lua_isnoneornil(state, 1) ? Json::object() : to_json(state, 1, binding.name);
    if (fields.is_array() && fields.empty()) fields = Json::object();
    check_fields(binding, fields);
    lua_pushinteger(state, sink_of(state).request(binding, std::move(fields)));
    return 1;
  });
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

void add_native(lua_State* state, RequestSink& sink, const char* name, lua_CFunction function) {
  lua_pushlightuserdata(state, &sink);
  lua_pushcclosure(state, function, 1);
  lua_setfield(state, -2, name);
}

}  // namespace

std::span<const Binding> bindings() { return kBindings; }

void check_fields(const Binding& binding, const Json& fields) {
  const std::string where = std::string(binding.name) + ": ";
  if (!fields.is_object())
    throw std::runtime_error(where + "allowed a table with named fields: write arm." + binding.name + " { ... }");
  std::string known;
  for (const BindingField& field : binding.fields) {
    known += (known.empty() ? "" : ", ") + std::string(field.name);
    const auto value = fields.find(field.name);
    if (value == fields.end() && field.required)
      throw std::runtime_error(where + field.name + ": missing: allowed " + field.type + ": add it");
    if (value != fields.end() && !has_type(*value, field.type)) {
      throw std::runtime_error(where + field.name + ": " + value->dump().substr(0, 60) + ": allowed " + field.type +
                               ": correct it");
    }
  }
  std::size_t found = 0;
  for (const BindingField& field : binding.fields) found += fields.count(field.name);
  if (found != fields.size())
    throw std::runtime_error(where + "unknown field: allowed " + (known.empty() ? "none" : known) + ": remove it");
}

void push_native(lua_State* state, RequestSink& sink) {
  lua_newtable(state);
  lua_newtable(state);
  for (const Binding& binding : kBindings) {
    lua_pushlightuserdata(state, &sink);
    lua_pushlightuserdata(state, const_cast<Binding*>(&binding));
    lua_pushcclosure(state, send_command, 2);
    lua_setfield(state, -2, binding.name);
  }
  lua_setfield(state, -2, "commands");
  add_native(state, sink, "progress", send_progress);
  add_native(state, sink, "report", send_report);
}

}  // namespace liana
