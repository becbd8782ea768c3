// The world of a script: a whitelist of Lua's functions, the dangerous ones capped, nothing that reaches outside.
#pragma once

#include <lua.hpp>

#include "host/apps/mission_runner/script_files.hpp"

namespace liana::mission_runner {

// Builds the sandbox in a new state (a lua_CFunction).
int open_sandbox(lua_State* state);

// `require` of Liana's own modules (a lua_CFunction): modules of the Lua folder, each run once.
int require_module(lua_State* state);

// `require` of scripts (a lua_CFunction): of Liana's own modules a read-only view, so that no script replaces a check.
int require_for_script(lua_State* state);

// Pushes the file as a function with an environment of its own; text only. Raises a Lua error for syntax errors.
void load_chunk(lua_State* state, const ScriptFile& file);

// Replaces functions of the open libraries that could run for ever in C or use up memory at once, by capped ones.
void cap_libraries(lua_State* state);

// `setmetatable` without finalisers, which Lua runs with hooks off (a lua_CFunction).
int guarded_setmetatable(lua_State* state);

// `tostring` without addresses, which differ from run to run (a lua_CFunction).
int plain_tostring(lua_State* state);

// `print` to standard error, where it cannot disturb what programs read (a lua_CFunction).
int print_to_stderr(lua_State* state);

}  // namespace liana::mission_runner
