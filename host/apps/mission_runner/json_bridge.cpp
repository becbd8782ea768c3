#include "host/apps/mission_runner/json_bridge.hpp"

#include <cmath>
#include <stdexcept>

#include "host/apps/mission_runner/script.hpp"
#include "host/base/json/json.hpp"
#include "host/base/text/printable.hpp"

namespace liana::mission_runner {
namespace {

constexpr int kDeepest = 24;
// What one conversion may make: a table that holds one table twice, twenty levels deep, is small in Lua alone.
constexpr std::size_t kMaxValueBytes = 16u << 20;
constexpr std::size_t kValueBytes = 64;  // of each value, about

// One conversion; knows where it is for messages.
class Reader {
 public:
  Reader(lua_State* state, const std::string& file) : state_(state), file_(file) {}

  Json read(int index, const std::string& path, int depth) {
    use(kValueBytes, path);
    switch (lua_type(state_, index)) {
      case LUA_TNIL:
        return nullptr;
      case LUA_TBOOLEAN:
        return lua_toboolean(state_, index) != 0;
      case LUA_TNUMBER:
        return number(index, path);
      case LUA_TSTRING:
        return text(index, path);
      case LUA_TTABLE:
        return table(lua_absindex(state_, index), path, depth);
      default:
        refuse(path, luaL_typename(state_, index), "numbers, texts, true, false and tables", "remove it");
    }
  }

 private:
  void use(std::size_t bytes, const std::string& path) {
    if (bytes > left_) refuse(path, "a table", "16 MiB in all", "hold less data, and no table many times");
    left_ -= bytes;
  }

  [[noreturn]] void refuse(const std::string& path, const std::string& value, const std::string& allowed,
                           const std::string& advice) const {
    throw std::runtime_error(file_ + ": " + (path.empty() ? "result" : text::printable(path, text::Lines::kOne)) +
                             ": " + value + ": allowed " + allowed + ": " + advice);
  }

  Json number(int index, const std::string& path) const {
    if (lua_isinteger(state_, index) != 0) return static_cast<std::int64_t>(lua_tointeger(state_, index));
    const double value = lua_tonumber(state_, index);
    if (!std::isfinite(value))
      refuse(path,
             std::isnan(value) ? "nan"
             : value < 0.0     ? "-inf"
                               : "inf",
             "finite numbers", "correct the computation");
    return value;
  }

  Json text(int index, const std::string& path) {
    std::size_t length = 0;
    const char* bytes = lua_tolstring(state_, index, &length);
    use(length, path);
    const std::string value(bytes, length);
    for (const char c : value) {
      if (static_cast<unsigned char>(c) >= 0x80 || static_cast<unsigned char>(c) < 0x20)
        refuse(path, "a text", "printable ASCII", "rewrite the text");
    }
    return value;
  }

  Json table(int index, const std::string& path, int depth) {
    if (depth > kDeepest || lua_checkstack(state_, 4) == 0)
      refuse(path, "a table", "at most 24 levels", "look for a table that contains itself");
    const auto length = static_cast<std::size_t>(lua_rawlen(state_, index));
    std::size_t keys = 0;
    std::size_t texts = 0;
    for (lua_pushnil(state_); lua_next(state_, index) != 0; lua_pop(state_, 1)) {
      ++keys;
      if (lua_type(state_, -2) == LUA_TSTRING) ++texts;
    }
    if (keys == texts && keys > 0) return object(index, path, depth);
    if (keys == length) return array(index, length, path, depth);
    refuse(path, "a table", "lists 1..n without gaps, or named fields only", "do not mix them");
  }

  Json array(int index, std::size_t length, const std::string& path, int depth) {
    Json out = Json::array();
    for (std::size_t i = 1; i <= length; ++i) {
      lua_rawgeti(state_, index, static_cast<lua_Integer>(i));
      out.push_back(read(-1, path + "[" + std::to_string(i) + "]", depth + 1));
      lua_pop(state_, 1);
    }
    return out;
  }

  Json object(int index, const std::string& path, int depth) {
    Json out = Json::object();
    for (lua_pushnil(state_); lua_next(state_, index) != 0; lua_pop(state_, 1)) {
      const std::string key = lua_tostring(state_, -2);  // a text already: no conversion in place
      use(key.size(), path);
      out[key] = read(-1, path.empty() ? key : path + "." + key, depth + 1);
    }
    return out;
  }

  lua_State* state_;
  const std::string& file_;
  std::size_t left_ = kMaxValueBytes;
};

void push_list(lua_State* state, const Json& list) {
  lua_createtable(state, static_cast<int>(list.size()), 0);
  for (std::size_t i = 0; i < list.size(); ++i) {
    push_json(state, list[i]);
    lua_rawseti(state, -2, static_cast<lua_Integer>(i + 1));
  }
}

void push_table(lua_State* state, const Json& table) {
  lua_createtable(state, 0, static_cast<int>(table.size()));
  for (const auto& [key, value] : table.items()) {
    push_json(state, value);
    lua_setfield(state, -2, key.c_str());
  }
}

}  // namespace

Json to_json(lua_State* state, int index, const std::string& file) {
  const int top = lua_gettop(state);
  try {
    return Reader(state, file).read(index, "", 0);
  } catch (...) {
    lua_settop(state, top);
    throw;
  }
}

void push_json(lua_State* state, const Json& value) {
  luaL_checkstack(state, 4, "JSON too deep");
  if (value.is_array()) return push_list(state, value);
  if (value.is_object()) return push_table(state, value);
  if (value.is_boolean()) return lua_pushboolean(state, value.get<bool>() ? 1 : 0);
  if (value.is_number_integer()) return lua_pushinteger(state, value.get<lua_Integer>());
  if (value.is_number()) return lua_pushnumber(state, value.get<double>());
  if (!value.is_string()) return lua_pushnil(state);
  const auto& text = value.text();
  lua_pushlstring(state, text.data(), text.size());
}

void push_in_protection(Script& script, const Json& value) {
  lua_pushcfunction(script.state(), [](lua_State* state) {
    push_json(state, *static_cast<const Json*>(lua_touserdata(state, 1)));
    return 1;
  });
  lua_pushlightuserdata(script.state(), const_cast<Json*>(&value));
  script.call(1, 1);
}

}  // namespace liana::mission_runner
