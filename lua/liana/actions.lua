-- Actions for `run` of a step and `finish` of a mission: functions of arm.
local need = require "liana.need"
local position = require "liana.position"
local uses = require "liana.uses"

local actions = {}

-- Joint motion to a named pose of the robot, at most rate_deg_s (default: the robot's limit).
function actions.move_to(name, rate_deg_s)
  need("move_to", "name", name, "string")
  if rate_deg_s ~= nil then need("move_to", "rate_deg_s", rate_deg_s, "number") end
  local fields = { rate_deg_s = rate_deg_s }
  return uses.noted(function(arm) arm.move_jp { goal_deg = arm.named_pose(name), rate_deg_s = rate_deg_s } end,
    { action = "move_to", pose = name, command = "move_jp", fields = fields, at = position(1) })
end

-- Joint motion to angles; fields of `move_jp` (docs/api.md): { goal_deg = { 0, 5, ... }, rate_deg_s = 1 }.
function actions.move_jp(fields)
  need("move_jp", "fields", fields, "table")
  return uses.noted(function(arm) arm.move_jp(fields) end, { action = "move_jp", command = "move_jp", fields = fields, at = position(1) })
end

-- The tip along a straight line to a pose in the base frame; fields of `move_cp` (docs/api.md): { goal = { x, y, z, qw, qx, qy, qz } }.
function actions.move_cp(fields)
  need("move_cp", "fields", fields, "table")
  return uses.noted(function(arm) arm.move_cp(fields) end, { action = "move_cp", command = "move_cp", fields = fields, at = position(1) })
end

-- Steers nodes by null-space targets { { node = 3, position_m = {x, y, z}, weight = 1, threshold_m = 0.01 }, ... } and pushes
-- the arm's middle away from points { { centre_m = {x, y, z}, distance_m = 0.3, weight = 1 }, ... } (optional). With `search` the best of
-- all shapes is looked for and gone to first; the arm has to be at rest.
function actions.shape(nodes, keep_clear, search)
  need("shape", "nodes", nodes, "table")
  if keep_clear ~= nil then need("shape", "keep_clear", keep_clear, "table") end
  if search ~= nil then need("shape", "search", search, "boolean") end
  local fields = { nodes = nodes, keep_clear = keep_clear, search = search }
  return uses.noted(function(arm) arm.shape(fields) end, { action = "shape", command = "shape", fields = fields, at = position(1) })
end

-- The tip goes to `offset` beside a target that the tip camera sees and stays there for the dwell; fields of `servo_target` (docs/api.md):
-- { target = "adapter", offset = { x, y, z, qw, qx, qy, qz }, ... }.
function actions.servo_target(fields)
  need("servo_target", "fields", fields, "table")
  return uses.noted(function(arm) arm.servo_target(fields) end,
    { action = "servo_target", command = "servo_target", fields = fields, at = position(1) })
end

-- A command to the tool at the tip.
function actions.tool(command)
  need("tool", "command", command, "string")
  return function(arm) arm.tool { command = command } end
end

return actions
