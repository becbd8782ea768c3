// Good tables to start from, and how a spoiled one must be refused.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "host/apps/mission_runner/evaluate.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "tests/message.hpp"

namespace liana::config {

constexpr double kDeg = 3.14159265358979323846 / 180.0;

// The project's own table, evaluated.
inline Json good_table(const std::string& kind, const std::string& name) {
  mission_runner::Activity activity;
  mission_runner::Script script(mission_runner::ScriptLimits{}, LIANA_LUA_DIR, activity);
  return Json::parse(mission_runner::evaluate(script, LIANA_LUA_DIR, kind, name));
}

// The shipped cable arm on its shipped buses, as the core is told of it.
inline RobotConfig nominal_zhu2022() {
  const BusesConfig buses = parse_buses(good_table("buses", "embedded").dump(), "b");
  return parse_robot(good_table("robot", "zhu2022").dump(), "r", "nominal", buses);
}

// One way to spoil a table, and what the message must name.
struct Spoiled {
  const char* pointer;  // JSON pointer of the field
  Json value;           // its new value; null removes the field
  const char* path;     // which the message names,
  Facts facts;          // and these
};

// Sets the field at "a/0/b", or removes it where `value` is null.
inline void spoil(Json& table, std::string_view path, const Json& value) {
  const std::size_t end = path.find('/');
  const std::string key(path.substr(0, end));
  if (end == path.npos && value.is_null()) return table.erase(key);
  Json& inside = table.is_array() ? table[std::stoul(key)] : table[key];
  if (end == path.npos) {
    inside = value;
  } else {
    spoil(inside, path.substr(end + 1), value);
  }
}

// The message with which `read` refuses the spoiled table; empty when it does not.
inline std::string message_of(Json table, const Spoiled& spoiled, const std::function<void(const std::string&)>& read) {
  spoil(table, std::string_view(spoiled.pointer).substr(1), spoiled.value);
  try {
    read(table.dump());
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

// Expects a message that names the file given.json, the path and the facts.
inline void expect_refused(const Json& table, const Spoiled& spoiled,
                           const std::function<void(const std::string&)>& read) {
  Facts facts{"given.json", spoiled.path};
  facts.insert(facts.end(), spoiled.facts.begin(), spoiled.facts.end());
  EXPECT_TRUE(names(message_of(table, spoiled, read), facts)) << spoiled.pointer;
}

}  // namespace liana::config
