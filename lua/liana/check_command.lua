-- Checks the constant fields of a command against the robot before anything moves, with the ranges that lianad has (docs/api.md).
local kind = require "liana.kind"

local function refuse(where, field, value, allowed)
  error(("%s: %s: %s: allowed %s: correct the step"):format(where, field, tostring(value), allowed), 0)
end

local function number_in(where, field, value, low, high, unit)
  if type(value) == "number" and value >= low and value <= high then return end
  refuse(where, field, value, ("%g to %g%s"):format(low, high, unit))
end

local function point(where, field, value, reach_m)
  local axes = "three coordinates { x, y, z } in m"
  if type(value) ~= "table" or #value ~= 3 then refuse(where, field, value, axes) end
  for axis = 1, 3 do number_in(where, ("%s[%d]"):format(field, axis), value[axis], -reach_m, reach_m, " m") end
end

local function entries(where, list, known, check)
  if #list > 4 then refuse(where, "entries", #list, "at most 4") end
  for key in pairs(list) do
    if math.type(key) ~= "integer" or key < 1 or key > #list then refuse(where, tostring(key), list[key], "a list of tables") end
  end
  for i, entry in ipairs(list) do
    local here = where .. ": entry " .. i
    if type(entry) ~= "table" then refuse(here, "entry", entry, "a table with " .. table.concat(known, ", ")) end
    for field, value in pairs(entry) do
      if not (" " .. table.concat(known, " ") .. " "):find(" " .. tostring(field) .. " ", 1, true) then
        refuse(here, tostring(field), value, "only " .. table.concat(known, ", "))
      end
    end
    check(here, entry)
  end
end

local function angles(where, goal_deg, robot)
  local count = kind.angle_count(robot)
  if type(goal_deg) ~= "table" or #goal_deg ~= count then
    refuse(where, "angles", type(goal_deg) == "table" and #goal_deg or goal_deg, ("%d (robot %s)"):format(count, robot.name))
  end
  for theta, angle_deg in ipairs(goal_deg) do
    local low_deg, high_deg = kind.range_deg(robot, theta)
    number_in(where, "theta " .. theta, angle_deg, low_deg, high_deg, " deg")
  end
end

local function reach_of(robot)
  local reach_m = 0
  for _, segment in ipairs(robot.segments) do reach_m = reach_m + segment.modules * segment.module_length_m end
  return reach_m
end

local commands = {}

function commands.shape(where, fields, robot)
  if kind.is_serial(robot) then refuse(where, "shape", "nodes", "cable arms only (robot " .. robot.name .. " has joints)") end
  local reach_m = reach_of(robot)
  entries(where .. ": nodes", fields.nodes, { "node", "position_m", "weight", "threshold_m" }, function(here, entry)
    local last = #robot.segments - 1
    local is_node = math.type(entry.node) == "integer" and entry.node >= 1 and entry.node <= last
    if not is_node then refuse(here, "node", entry.node, ("1 to %d (the tip, %d, has its own goal)"):format(last, last + 1)) end
    point(here, "position_m", entry.position_m, reach_m)
    number_in(here, "weight", entry.weight or 0, 0, 1000, "")
    number_in(here, "threshold_m", entry.threshold_m or 0, 0, reach_m, " m")
  end)
  entries(where .. ": keep_clear", fields.keep_clear or {}, { "centre_m", "distance_m", "weight" }, function(here, entry)
    point(here, "centre_m", entry.centre_m, reach_m)
    number_in(here, "distance_m", entry.distance_m, 0, reach_m, " m")
    number_in(here, "weight", entry.weight or 0, 0, 1000, "")
  end)
end

function commands.move_jp(where, fields, robot)
  if fields.goal_deg then angles(where .. ": goal_deg", fields.goal_deg, robot) end
  if fields.rate_deg_s then number_in(where, "rate_deg_s", fields.rate_deg_s, 0.01, kind.rate_deg_s(robot), " deg/s") end
end

-- `use` as lua/liana/uses.lua says; nothing to check when it names no command.
return function(where, use, robot)
  if use.command then commands[use.command](where .. ": " .. use.action, use.fields, robot) end
end
