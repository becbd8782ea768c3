// Lua values to JSON and back.
#pragma once

#include <lua.hpp>
#include <string>

#include "host/base/json/json_fwd.hpp"

namespace liana::mission_runner {

// The value at `index` as JSON: tables with keys 1..n are arrays (an empty table is one), tables with text keys
// objects. Raises no Lua error apart from lack of memory; throws std::runtime_error naming `file` and field for what
// JSON cannot hold.
Json to_json(lua_State* state, int index, const std::string& file);

// Pushes `value` on the stack of a protected call (may raise lack of memory); null becomes nil.
void push_json(lua_State* state, const Json& value);

class Script;
// The same from outside a protected call; throws std::runtime_error as Script::call does.
void push_in_protection(Script& script, const Json& value);

}  // namespace liana::mission_runner
