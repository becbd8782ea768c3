// The commands missions can give: what the table of requests (host/api/server/request_table.hpp) marks as theirs.
#pragma once

#include <lua.hpp>
#include <optional>
#include <vector>

#include "host/api/server/request_table.hpp"
#include "host/base/json/json_fwd.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::mission_runner {

// All commands, in the order of docs/reference/api.md. Each is a function of one table that sends {"op": name, ...} and
// returns the request id.
std::vector<const api::RequestRow*> commands();

// Where commands go.
class RequestSink {
 public:
  virtual ~RequestSink() = default;
  // Sends a request and returns its id.
  virtual std::int64_t request(const api::RequestRow& row, Json fields) = 0;
  // Progress of the mission, see lua/liana/engine.lua.
  virtual void progress(const Json& event) = 0;
  // The report as far as it is known: see GrowingReport::take.
  virtual void report(const Json& report) = 0;
  // A curve as waypoints, see follow_plan.hpp; valid until the next one.
  virtual const Json& plan_curve(const Json& request) = 0;
};

// Pushes { commands = { name = function }, progress, report, plan_curve, attempt (script.hpp) = functions }; `sink`
// must outlive the state.
void push_native(lua_State* state, RequestSink& sink);

// The robot that shall do what a mission asks for.
struct RobotAtHand {
  api::RequestBounds bounds;
  std::optional<config::SerialRobotConfig> serial;  // where it has a serial arm
};

// Pushes a function (command, fields) -> what lianad would refuse about them with this robot, or nil; `robot` must
// outlive the state.
void push_refusal(lua_State* state, const RobotAtHand& robot);

}  // namespace liana::mission_runner
