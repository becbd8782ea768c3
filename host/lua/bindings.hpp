// The commands missions can give, in one table: registration, checks, stubs and documentation follow from it.
#pragma once

#include <lua.hpp>
#include <span>
#include <string>

#include "host/json/json_fwd.hpp"

namespace liana {

// One field of a command's table argument.
struct BindingField {
  const char* name;
  const char* type;  // as the stubs write it: number, integer, string, number[], table, table[]
  bool required;
};

// One command: a function of one table that sends {"op": name, ...} (docs/api.md) and returns the request id.
struct Binding {
  const char* name;
  std::span<const BindingField> fields;
};

// All commands, in the order of docs/api.md.
std::span<const Binding> bindings();

// Checks the names and types of a command's fields (ranges are lianad's business). Throws std::runtime_error.
void check_fields(const Binding& binding, const Json& fields);

// Where commands go.
class RequestSink {
 public:
  virtual ~RequestSink() = default;
  // Sends a request and returns its id.
  virtual std::int64_t request(const Binding& binding, Json fields) = 0;
  // Progress of the mission, see lua/liana/engine.lua.
  virtual void progress(const Json& event) = 0;
  // The report as far as it is known.
  virtual void report(const Json& report) = 0;
};

// Pushes { commands = { name = function }, progress = function, report = function }; `sink` must outlive the state.
void push_native(lua_State* state, RequestSink& sink);

}  // namespace liana
