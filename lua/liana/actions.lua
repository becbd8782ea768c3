-- Actions for `run` of a step and `finish` of a mission: functions of arm.
local check_argument = require "liana.check_argument"
local position = require "liana.position"
local action_requirements = require "liana.action_requirements"

local actions = {}

-- An action that gives one command; `at` is the line that asks for it.
local function giving(command, fields, at)
  return action_requirements.noted(function(arm) arm[command](fields) end, { action = command, command = command, fields = fields, at = at })
end

-- Joint motion to a named pose of the robot, at most rate_deg_s (default: the robot's limit).
function actions.move_to(name, rate_deg_s)
  check_argument("move_to", "name", name, "string")
  if rate_deg_s ~= nil then check_argument("move_to", "rate_deg_s", rate_deg_s, "number") end
  local fields = { rate_deg_s = rate_deg_s }
  return action_requirements.noted(function(arm) arm.move_jp { goal_deg = arm.named_pose(name), rate_deg_s = rate_deg_s } end,
    { action = "move_to", pose = name, command = "move_jp", fields = fields, at = position(1) })
end

-- Joint motion to angles; fields of `move_jp` (docs/reference/api.md): { goal_deg = { 0, 5, ... }, rate_deg_s = 1 }.
function actions.move_jp(fields)
  check_argument("move_jp", "fields", fields, "table")
  return giving("move_jp", fields, position(1))
end

-- The tip along a straight line to a pose in the base frame; fields of `move_cp` (docs/reference/api.md): { goal = { x,
-- y, z, qw, qx, qy, qz } }.
function actions.move_cp(fields)
  check_argument("move_cp", "fields", fields, "table")
  return giving("move_cp", fields, position(1))
end

local kFollowMargin_m = 0.005

local waypoints_of = {} -- a curve's table -> the waypoints of its last plan, degrees

local function check_curve(action, curve)
  check_argument(action, "curve", curve, "table")
  for field in pairs(curve) do
    if field ~= "points" and field ~= "margin_m" then
      error(("%s: curve.%s: allowed points, margin_m: correct its spelling"):format(action, tostring(field)), 3)
    end
  end
  if type(curve.points) ~= "table" or #curve.points < 2 then
    error(action .. ": curve.points: allowed 2 points or more, { {x, y, z}, ... }, metres in the base frame: correct the call", 3)
  end
end

local function go_along(arm, curve, waypoints_deg)
  arm.path_end_deg = waypoints_deg[#waypoints_deg]
  arm.move_path { points_deg = waypoints_deg, margin_m = curve.margin_m or kFollowMargin_m }
end

-- Follow the leader: the tip goes along a curve { points = { {x, y, z}, ... }, margin_m = 0.005 } in the base frame, the body after
-- it. The first point is where the tip is. The way is planned when the step runs, and lianad checks it. Every link keeps `margin_m`.
-- For cable arms only.
function actions.follow_curve(curve)
  check_curve("follow_curve", curve)
  return action_requirements.noted(function(arm)
    local margin_m = curve.margin_m or kFollowMargin_m
    local plan = arm.plan_curve { from_deg = arm.state.setpoint_js_deg, points = curve.points, margin_m = margin_m }
    waypoints_of[curve] = plan.waypoints_deg
    go_along(arm, curve, plan.waypoints_deg)
  end, { action = "follow_curve", is_for_cables = true, at = position(1) })
end

-- Back along the curve that an earlier step has followed, given as the same table.
function actions.follow_back(curve)
  check_curve("follow_back", curve)
  return action_requirements.noted(function(arm)
    local there, back = waypoints_of[curve], {}
    if there == nil then error("follow_back: no step has followed this curve: follow it first, by the same table", 0) end
    for i = #there, 1, -1 do back[#back + 1] = there[i] end
    go_along(arm, curve, back)
  end, { action = "follow_back", is_for_cables = true, at = position(1) })
end

-- Moves nodes by null-space targets { { node = 3, position_m = {x, y, z}, weight = 1, threshold_m = 0.01 }, ... } and pushes
-- the arm's middle away from points { { center_m = {x, y, z}, distance_m = 0.3, weight = 1 }, ... } (optional). With `search` the arm
-- first moves to the best of all shapes; it has to be at rest.
function actions.shape(nodes, keep_clear, search)
  check_argument("shape", "nodes", nodes, "table")
  if keep_clear ~= nil then check_argument("shape", "keep_clear", keep_clear, "table") end
  if search ~= nil then check_argument("shape", "search", search, "boolean") end
  return giving("shape", { nodes = nodes, keep_clear = keep_clear, search = search }, position(1))
end

-- The tip goes to `offset` beside a target that the tip camera sees and stays there for `dwell_s`; fields of
-- `servo_target` (docs/reference/api.md): { target = "adapter", offset = { x, y, z, qw, qx, qy, qz }, ... }.
function actions.servo_target(fields)
  check_argument("servo_target", "fields", fields, "table")
  return giving("servo_target", fields, position(1))
end

-- Moves along an axis of the tip under force control, from rest; fields of `insert` (docs/reference/api.md): { force_N =
-- 30, ... }. How it goes is `insert` of the state. For serial arms only.
function actions.insert(fields)
  check_argument("insert", "fields", fields, "table")
  return giving("insert", fields, position(1))
end

-- From rest, the joints give way to forces, until the next request. For serial arms only.
function actions.comply() return giving("comply", {}, position(1)) end

-- What the arm carries beside its tool from now on; fields of `payload` (docs/reference/api.md): { mass_kg = 0.2, center_m =
-- {x, y, z} }, of serial arms with inertia_kgm2 = {...}. A cable arm has to be at rest.
function actions.payload(fields)
  check_argument("payload", "fields", fields, "table")
  return giving("payload", fields, position(1))
end

-- Commands the adapter to "lock" or to "release" the payload. For serial arms only.
function actions.adapter(command)
  check_argument("adapter", "command", command, "string")
  return giving("adapter", { command = command }, position(1))
end

-- A command to the tool at the tip.
function actions.tool(command)
  check_argument("tool", "command", command, "string")
  return function(arm) arm.tool { command = command } end
end

return actions
