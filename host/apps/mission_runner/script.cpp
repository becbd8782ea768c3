#include "host/apps/mission_runner/script.hpp"

#include <array>
#include <cstdlib>
#include <stdexcept>

#include "host/apps/mission_runner/sandbox.hpp"
#include "host/base/text/printable.hpp"

namespace liana::mission_runner {
namespace {

constexpr int kHookInstructions = 1000;
constexpr std::size_t kLongestError = 2000;  // of an attempt [bytes]

void* allocate(void* user, void* old, std::size_t old_size, std::size_t new_size) {
  auto& budget = *static_cast<Script::Budget*>(user);
  const std::size_t before = old == nullptr ? 0 : old_size;  // without a block, Lua passes a type tag as the size
  if (new_size > before && budget.memory_used + (new_size - before) > budget.limits.memory_bytes) return nullptr;
  void* block = nullptr;
  if (new_size == 0) {
    std::free(old);
  } else {
    block = std::realloc(old, new_size);
    if (block == nullptr) return nullptr;
  }
  budget.memory_used += new_size;
  budget.memory_used -= before;
  return block;
}

// Notes where the script is; stops it when its budget is used up, and then again at every instruction, so that pcall
// does not help.
void count_hook(lua_State* state, lua_Debug* where) {
  Script::Budget& budget = script_budget(state);
  if (lua_getinfo(state, "Sl", where) != 0 && where->currentline > 0) {
    budget.activity->line.store(static_cast<std::uint32_t>(where->currentline), std::memory_order_relaxed);
    put_text(budget.activity->file, where->short_src);
  }
  budget.instructions_used += kHookInstructions;
  if (budget.instructions_used <= budget.limits.instructions) return;
  lua_sethook(state, count_hook, LUA_MASKCOUNT, 1);
  luaL_error(
      state,
      "%s:%d: computes too long: allowed %d million instructions before giving back control: look for an endless loop",
      where->short_src, where->currentline, static_cast<int>(budget.limits.instructions / 1'000'000));
}

std::string error_text(lua_State* state, int status, const ScriptLimits& limits) {
  if (status == LUA_ERRMEM) {
    return "the script uses too much memory: allowed " + std::to_string(limits.memory_bytes >> 20) +
           " MiB: keep less data";
  }
  const char* text = lua_tostring(state, -1);
  return text != nullptr
             ? text
             : std::string("the script raised a ") + luaL_typename(state, -1) + " as its error: raise texts";
}

struct FileToLoad {
  const ScriptFile* file;
};

int load_in_protection(lua_State* state) {
  const auto* request = static_cast<const FileToLoad*>(lua_touserdata(state, 1));
  load_chunk(state, *request->file);
  return 1;
}

// After a script's error: what it was stopped for is not what the next one does.
void start_afresh(lua_State* state, int status) {
  script_budget(state).instructions_used = 0;
  lua_sethook(state, count_hook, LUA_MASKCOUNT, kHookInstructions);
  if (status == LUA_ERRMEM) lua_gc(state, LUA_GCCOLLECT);
}

}  // namespace

int attempt(lua_State* state) {
  luaL_checkany(state, 1);
  const int status = lua_pcall(state, lua_gettop(state) - 1, LUA_MULTRET, 0);
  if (status == LUA_OK) {
    lua_pushboolean(state, 1);
    lua_insert(state, 1);
    return lua_gettop(state);
  }
  std::array<char, kLongestError> text{};  // no C++ object is left when Lua raises an error below
  put_text(text, error_text(state, status, script_budget(state).limits));
  lua_settop(state, 0);
  start_afresh(state, status);
  lua_pushboolean(state, 0);
  lua_pushstring(state, text.data());
  return 2;
}

Script::Script(const ScriptLimits& limits, const LuaFolders& lua_folders, Activity& activity) {
  budget_.limits = limits;
  budget_.activity = &activity;
  budget_.lua_folders = lua_folders;
  state_ = lua_newstate(allocate, &budget_);
  if (state_ == nullptr) throw std::runtime_error("Lua does not start: no memory");
  *static_cast<Budget**>(lua_getextraspace(state_)) = &budget_;  // coroutines inherit it
  lua_pushcfunction(state_, open_sandbox);
  call(0, 0);
  lua_sethook(state_, count_hook, LUA_MASKCOUNT, kHookInstructions);
}

Script::~Script() { lua_close(state_); }

void Script::run(const ScriptFile& file) {
  budget_.beside = file.folder;
  budget_.files.push_back(file);
  FileToLoad request{&file};
  lua_pushcfunction(state_, load_in_protection);
  lua_pushlightuserdata(state_, &request);
  call(1, 1);
  call(0, 1);
}

void Script::require(const std::string& name) {
  lua_pushcfunction(state_, require_module);
  lua_pushlstring(state_, name.data(), name.size());
  call(1, 1);
}

void Script::call(int arguments, int results) {
  budget_.instructions_used = 0;
  const int status = lua_pcall(state_, arguments, results, 0);
  if (status == LUA_OK) return;
  const std::string text = text::printable(error_text(state_, status, budget_.limits), text::Lines::kMany);
  lua_pop(state_, 1);
  throw std::runtime_error(text);
}

Script::Budget& script_budget(lua_State* state) { return **static_cast<Script::Budget**>(lua_getextraspace(state)); }

}  // namespace liana::mission_runner
