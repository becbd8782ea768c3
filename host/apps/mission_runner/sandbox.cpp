#include "host/apps/mission_runner/sandbox.hpp"

#include <array>
#include <cstring>
#include <exception>
#include <string_view>

#include "host/apps/mission_runner/script.hpp"

namespace liana::mission_runner {
namespace {

constexpr const char* kGlobals = "liana.globals";  // registry: what every environment falls back to
constexpr const char* kModules = "liana.modules";  // registry: results of require
constexpr const char* kViews = "liana.views";      // registry: what scripts get of Liana's own modules
constexpr const char* kLoading = "liana.loading";  // value of a module that is being run

// Functions scripts get from the base library, as they are.
constexpr std::array<const char*, 12> kBase = {"assert", "error",  "ipairs",   "pcall",    "xpcall", "select",
                                               "type",   "rawget", "rawequal", "tonumber", "rawlen", "getmetatable"};
constexpr std::array<const char*, 25> kMath = {"abs",       "ceil",       "floor",      "sqrt",  "sin", "cos",  "tan",
                                               "asin",      "acos",       "atan",       "exp",   "log", "fmod", "modf",
                                               "max",       "min",        "pi",         "huge",  "deg", "rad",  "type",
                                               "tointeger", "maxinteger", "mininteger", "random"};
constexpr std::array<const char*, 13> kString = {"byte",  "char",  "find", "format",  "gmatch", "gsub", "len",
                                                 "lower", "match", "rep",  "reverse", "sub",    "upper"};
constexpr std::array<const char*, 6> kTable = {"concat", "insert", "pack", "remove", "sort", "unpack"};
constexpr std::array<const char*, 7> kCoroutine = {"create", "isyieldable", "resume", "running",
                                                   "status", "wrap",        "yield"};

// pairs in the order of keys: numbers, then texts. Lua's own order changes from process to process, and runs must
// repeat.
constexpr const char* kOrderedPairs = R"lua(
local next, sort, type, error = ...
local function before(a, b)
  local numbers = (type(a) == "number" and 1 or 0) - (type(b) == "number" and 1 or 0)
  if numbers ~= 0 then return numbers > 0 end
  return a < b
end
return function(t)
  local keys, i = {}, 0
  for key in next, t do
    if type(key) ~= "number" and type(key) ~= "string" then error("pairs: keys must be numbers or texts, not a " .. type(key), 2) end
    keys[#keys + 1] = key
  end
  sort(keys, before)
  return function()
    repeat i = i + 1 until keys[i] == nil or t[keys[i]] ~= nil
    return keys[i], t[keys[i]]
  end, t
end
)lua";

int refuse_write(lua_State* state) {
  return luaL_error(state, "this table is read-only: keep your own data in local variables");
}

void make_read_only(lua_State* state);

// view[key]: tables within are read-only, too. Upvalue 1: the table itself.
int read_through(lua_State* state) {
  lua_settop(state, 2);
  lua_gettable(state, lua_upvalueindex(1));
  if (lua_istable(state, -1)) make_read_only(state);
  return 1;
}

int length_through(lua_State* state) {
  lua_pushinteger(state, luaL_len(state, lua_upvalueindex(1)));
  return 1;
}

// Replaces the table on top by a read-only view of it.
void make_read_only(lua_State* state) {
  lua_newtable(state);
  lua_createtable(state, 0, 4);
  lua_pushvalue(state, -3);
  lua_pushcclosure(state, read_through, 1);
  lua_setfield(state, -2, "__index");
  lua_pushvalue(state, -3);
  lua_pushcclosure(state, length_through, 1);
  lua_setfield(state, -2, "__len");
  lua_pushcfunction(state, refuse_write);
  lua_setfield(state, -2, "__newindex");
  lua_pushboolean(state, 0);
  lua_setfield(state, -2, "__metatable");
  lua_setmetatable(state, -2);
  lua_remove(state, -2);
}

// Copies fields of the table at `from` to the table on top.
template <std::size_t N>
void copy_fields(lua_State* state, int from, const std::array<const char*, N>& names) {
  for (const char* name : names) {
    lua_getfield(state, from, name);
    lua_setfield(state, -2, name);
  }
}

// globals[name] = read-only table of the library's whitelisted functions; the globals are on top.
template <std::size_t N>
void add_library(lua_State* state, const char* name, const std::array<const char*, N>& functions) {
  lua_getglobal(state, name);
  lua_newtable(state);
  copy_fields(state, lua_absindex(state, -2), functions);
  if (std::strcmp(name, "string") == 0) {  // methods of texts are the same capped functions
    lua_pushliteral(state, "");
    lua_createtable(state, 0, 2);
    lua_pushvalue(state, -3);
    lua_setfield(state, -2, "__index");
    lua_pushboolean(state, 0);
    lua_setfield(state, -2, "__metatable");
    lua_setmetatable(state, -2);
    lua_pop(state, 1);
  }
  make_read_only(state);
  lua_setfield(state, -3, name);
  lua_pop(state, 1);
}

void add_function(lua_State* state, const char* name, lua_CFunction function) {
  lua_pushcfunction(state, function);
  lua_setfield(state, -2, name);
}

void add_ordered_pairs(lua_State* state) {
  if (luaL_loadbufferx(state, kOrderedPairs, std::strlen(kOrderedPairs), "=pairs", "t") != LUA_OK) lua_error(state);
  lua_getglobal(state, "next");
  lua_getglobal(state, "table");
  lua_getfield(state, -1, "sort");
  lua_remove(state, -2);
  for (const char* name : {"type", "error"}) lua_getglobal(state, name);
  lua_call(state, 4, 1);
  lua_setfield(state, -2, "pairs");
}

// The same numbers in every run: seeded here, and scripts cannot seed.
void add_random(lua_State* state) {
  lua_getglobal(state, "math");
  lua_getfield(state, -1, "randomseed");
  lua_pushinteger(state, 1);
  lua_call(state, 1, 0);
  lua_pop(state, 1);
}

void open_libraries(lua_State* state) {
  const std::array<luaL_Reg, 5> libraries = {{{LUA_GNAME, luaopen_base},
                                              {LUA_MATHLIBNAME, luaopen_math},
                                              {LUA_STRLIBNAME, luaopen_string},
                                              {LUA_TABLIBNAME, luaopen_table},
                                              {LUA_COLIBNAME, luaopen_coroutine}}};
  for (const luaL_Reg& library : libraries) {
    luaL_requiref(state, library.name, library.func, 1);
    lua_pop(state, 1);
  }
}

// Whose code it is: Liana's modules read and change each other, a script's get read-only views of Liana's.
enum class Author { kLiana, kScript };

// Pushes the module's chunk; C++ objects are gone when a Lua error may be raised.
bool push_module_chunk(lua_State* state, const char* name, Author& author, std::array<char, 400>& problem) {
  ScriptFile file;
  try {
    Script::Budget& budget = script_budget(state);
    file = find_module(budget.lua_folders, budget.beside, name);
    if (file.is_beside) budget.files.push_back(file);
    const std::string_view called = name;
    const bool is_own = !file.is_beside && (called == "liana" || called.starts_with("liana."));
    author = is_own ? Author::kLiana : Author::kScript;
  } catch (const std::exception& error) {
    put_text(problem, error.what());
    return false;
  }
  if (luaL_loadbufferx(state, file.text.data(), file.text.size(), ("@" + file.display).c_str(), "t") == LUA_OK)
    return true;
  put_text(problem, lua_tostring(state, -1));
  return false;
}

// Gives the function on top an environment of its own that falls back to the globals.
void give_environment(lua_State* state, Author author) {
  lua_newtable(state);
  if (author == Author::kLiana) add_function(state, "require", require_module);
  lua_createtable(state, 0, 2);
  lua_getfield(state, LUA_REGISTRYINDEX, kGlobals);
  lua_setfield(state, -2, "__index");
  lua_pushboolean(state, 0);
  lua_setfield(state, -2, "__metatable");
  lua_setmetatable(state, -2);
  lua_setupvalue(state, -2, 1);
}

// A module that did not load can be asked for again.
void forget_module(lua_State* state, int modules, const char* name) {
  lua_pushnil(state);
  lua_setfield(state, modules, name);
}

}  // namespace

int open_sandbox(lua_State* state) {
  open_libraries(state);
  add_random(state);
  lua_newtable(state);
  add_ordered_pairs(state);
  cap_libraries(state);
  lua_pushglobaltable(state);
  lua_insert(state, -2);
  copy_fields(state, lua_absindex(state, -2), kBase);
  lua_remove(state, -2);
  add_library(state, "math", kMath);
  add_library(state, "string", kString);
  add_library(state, "table", kTable);
  add_library(state, "coroutine", kCoroutine);
  add_function(state, "setmetatable", guarded_setmetatable);
  add_function(state, "tostring", plain_tostring);
  add_function(state, "print", print_to_stderr);
  add_function(state, "require", require_for_script);
  lua_setfield(state, LUA_REGISTRYINDEX, kGlobals);
  for (const char* table : {kModules, kViews}) {
    lua_newtable(state);
    lua_setfield(state, LUA_REGISTRYINDEX, table);
  }
  return 0;
}

void load_chunk(lua_State* state, const ScriptFile& file) {
  std::array<char, 200> chunk_name{};
  put_text(chunk_name, "@" + file.display);
  if (luaL_loadbufferx(state, file.text.data(), file.text.size(), chunk_name.data(), "t") != LUA_OK) lua_error(state);
  give_environment(state, Author::kScript);
}

int require_module(lua_State* state) {
  const char* name = luaL_checkstring(state, 1);
  lua_getfield(state, LUA_REGISTRYINDEX, kModules);
  const int modules = lua_gettop(state);
  lua_getfield(state, -1, name);
  if (lua_islightuserdata(state, -1))
    return luaL_error(state, "require: %s: modules require each other in a circle: break the circle", name);
  if (!lua_isnil(state, -1)) return 1;
  lua_pop(state, 1);
  lua_pushlightuserdata(state, const_cast<char*>(kLoading));
  lua_setfield(state, -2, name);
  std::array<char, 400> problem{};
  Author author = Author::kScript;
  if (!push_module_chunk(state, name, author, problem)) {
    forget_module(state, modules, name);
    return luaL_error(state, "%s", problem.data());
  }
  give_environment(state, author);
  if (lua_pcall(state, 0, 1, 0) != LUA_OK) {
    forget_module(state, modules, name);
    return lua_error(state);
  }
  if (lua_isnil(state, -1)) {
    forget_module(state, modules, name);
    return luaL_error(
        state, "require: %s: the module returns nothing: allowed a table or a function: end it with return", name);
  }
  lua_pushvalue(state, -1);
  lua_setfield(state, modules, name);
  if (author == Author::kScript || !lua_istable(state, -1)) return 1;
  lua_getfield(state, LUA_REGISTRYINDEX, kViews);
  lua_pushvalue(state, -2);
  make_read_only(state);
  lua_setfield(state, -2, name);
  lua_pop(state, 1);
  return 1;
}

int require_for_script(lua_State* state) {
  const char* name = luaL_checkstring(state, 1);
  require_module(state);
  lua_getfield(state, LUA_REGISTRYINDEX, kViews);
  if (lua_getfield(state, -1, name) == LUA_TNIL) lua_pop(state, 2);
  return 1;
}

}  // namespace liana::mission_runner
