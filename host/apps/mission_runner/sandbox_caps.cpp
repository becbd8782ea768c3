// Functions of Lua's libraries that run for long or use much memory in one instruction, each behind a cap.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>

#include "host/apps/mission_runner/sandbox.hpp"
#include "host/apps/mission_runner/script.hpp"
#include "host/base/text/printable.hpp"

namespace liana::mission_runner {
namespace {

constexpr lua_Integer kLongestSubject = 4096;  // of a pattern match [bytes]
constexpr lua_Integer kLongestPattern = 64;
constexpr lua_Integer kLongestRepetition = 1 << 20;  // of string.rep [bytes]
constexpr lua_Integer kLongestSort = 10000;          // entries

// Calls the library's own function (upvalue 1) with the arguments as they are.
int call_original(lua_State* state) {
  const int arguments = lua_gettop(state);
  lua_pushvalue(state, lua_upvalueindex(1));
  lua_insert(state, 1);
  lua_call(state, arguments, LUA_MULTRET);
  return lua_gettop(state);
}

int capped_match(lua_State* state) {
  std::size_t subject = 0;
  std::size_t pattern = 0;
  luaL_checklstring(state, 1, &subject);
  luaL_checklstring(state, 2, &pattern);
  if (static_cast<lua_Integer>(subject) > kLongestSubject || static_cast<lua_Integer>(pattern) > kLongestPattern) {
    return luaL_error(state, "pattern match too long: allowed %I bytes of text and %I of pattern: split the text",
                      kLongestSubject, kLongestPattern);
  }
  return call_original(state);
}

int capped_rep(lua_State* state) {
  std::size_t text = 0;
  std::size_t separator = 0;
  luaL_checklstring(state, 1, &text);
  const lua_Integer count = luaL_checkinteger(state, 2);
  luaL_optlstring(state, 3, "", &separator);
  const auto piece = static_cast<lua_Integer>(text + separator);
  if (count > 0 && piece > 0 && count > kLongestRepetition / piece) {
    return luaL_error(state, "string.rep: too long: allowed %I bytes: build less text (out of memory otherwise)",
                      kLongestRepetition);
  }
  return call_original(state);
}

int capped_sort(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  if (luaL_len(state, 1) > kLongestSort)
    return luaL_error(state, "table.sort: too long: allowed %I entries: sort less", kLongestSort);
  return call_original(state);
}

// Addresses differ from run to run, and tell where things lie: %p is refused, and what is no text is written as
// tostring does.
int plain_format(lua_State* state) {
  const char* at = luaL_checkstring(state, 1);
  while ((at = std::strchr(at, '%')) != nullptr) {
    ++at;
    at += std::strspn(at, "-+ #0123456789.");
    if (*at == 'p') return luaL_error(state, "string.format: %%p is not allowed: do without addresses");
    if (*at != '\0') ++at;
  }
  for (int i = 2; i <= lua_gettop(state); ++i) {
    const int type = lua_type(state, i);
    if (type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING) continue;
    lua_pushcfunction(state, plain_tostring);
    lua_pushvalue(state, i);
    lua_call(state, 1, 1);
    lua_replace(state, i);
  }
  return call_original(state);
}

// library.name = function with the original as its upvalue.
void replace(lua_State* state, const char* library, const char* name, lua_CFunction function) {
  lua_getglobal(state, library);
  lua_getfield(state, -1, name);
  lua_pushcclosure(state, function, 1);
  lua_setfield(state, -2, name);
  lua_pop(state, 1);
}

}  // namespace

void cap_libraries(lua_State* state) {
  for (const char* name : {"find", "match", "gmatch", "gsub"}) replace(state, "string", name, capped_match);
  replace(state, "string", "rep", capped_rep);
  replace(state, "string", "format", plain_format);
  replace(state, "table", "sort", capped_sort);
}

int guarded_setmetatable(lua_State* state) {
  luaL_checktype(state, 1, LUA_TTABLE);
  if (!lua_isnoneornil(state, 2)) luaL_checktype(state, 2, LUA_TTABLE);
  if (lua_istable(state, 2)) {
    for (const char* field : {"__gc", "__mode"}) {
      lua_pushstring(state, field);
      if (lua_rawget(state, 2) != LUA_TNIL)
        return luaL_error(state, "setmetatable: %s is not allowed: do without it", field);
      lua_pop(state, 1);
    }
  }
  if (luaL_getmetafield(state, 1, "__metatable") != LUA_TNIL)
    return luaL_error(state, "setmetatable: this metatable is protected");
  lua_settop(state, 2);
  lua_setmetatable(state, 1);
  return 1;
}

int plain_tostring(lua_State* state) {
  luaL_checkany(state, 1);
  if (luaL_getmetafield(state, 1, "__tostring") != LUA_TNIL) {
    lua_pushvalue(state, 1);
    lua_call(state, 1, 1);
    return 1;
  }
  const int type = lua_type(state, 1);
  if (type == LUA_TNIL || type == LUA_TBOOLEAN || type == LUA_TNUMBER || type == LUA_TSTRING) {
    luaL_tolstring(state, 1, nullptr);
  } else {
    lua_pushstring(state, lua_typename(state, type));
  }
  return 1;
}

namespace {

// Whether the script may print so much more; says once when it may not.
bool may_print(Script::Budget& budget, std::size_t bytes) {
  const std::size_t most = budget.limits.printed_bytes;
  if (budget.printed_bytes > most) return false;
  budget.printed_bytes += bytes;
  if (budget.printed_bytes <= most) return true;
  std::fprintf(stderr, "print: over %zu KiB: the rest is left out\n", most >> 10);
  return false;
}

}  // namespace

int print_to_stderr(lua_State* state) {
  const int count = lua_gettop(state);
  lua_pushliteral(state, "");
  for (int i = 1; i <= count; ++i) {
    if (i > 1) lua_pushliteral(state, "\t");
    lua_pushcfunction(state, plain_tostring);
    lua_pushvalue(state, i);
    lua_call(state, 1, 1);
    lua_concat(state, i > 1 ? 3 : 2);
  }
  std::size_t bytes = 0;
  const char* text = lua_tolstring(state, -1, &bytes);
  if (text != nullptr && may_print(script_budget(state), bytes + 1))
    std::fprintf(stderr, "%s\n", text::printable({text, bytes}, text::Lines::kMany).c_str());
  return 0;
}

}  // namespace liana::mission_runner
