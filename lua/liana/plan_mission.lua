-- A plan of `liana plan --out` as a mission: the arm goes from waypoint to waypoint, straight in theta and at rest at each, which is the
-- way that the planner has checked. It has to stand at the start of the plan: the way from anywhere else is not checked.
local check = require "liana.check"
local conditions = require "liana.conditions"
local uses = require "liana.uses"

local kAtStart_deg = 1.0 -- of every theta from the first waypoint
local kArrived_deg = 0.02
local kTimeLimit_s = 300 -- of one waypoint; 40 deg take 54 s

local function refuse(field, value, allowed, advice)
  error(("plan: %s: %s: allowed %s: %s"):format(field, tostring(value), allowed, advice), 0)
end

local function within(waypoint_deg, tolerance_deg, text)
  return conditions.condition(text, function(arm)
    for i, target_deg in ipairs(waypoint_deg) do
      if math.abs(arm.state.setpoint_js_deg[i] - target_deg) > tolerance_deg then return false end
    end
    return true
  end)
end

local function step_to(index, count, waypoint_deg)
  local name, fields = ("waypoint %d of %d"):format(index, count), { goal_deg = waypoint_deg }
  return {
    name = name, device = "none", time_limit_s = kTimeLimit_s, on_fail = "hold",
    enter = index == 1 and within(waypoint_deg, kAtStart_deg, ("arm within %g deg of the plan's start"):format(kAtStart_deg)) or nil,
    run = uses.noted(function(arm) arm.move_jp(fields) end, { action = name, command = "move_jp", fields = fields }),
    exit = conditions.all { within(waypoint_deg, kArrived_deg, "at the waypoint"), conditions.at_rest() },
  }
end

-- The checked mission of a plan (docs/formats.md).
return function(plan)
  if type(plan) ~= "table" or plan.outcome ~= "solved" then
    refuse("outcome", type(plan) == "table" and plan.outcome or plan, "solved", "give a file that liana plan --out has written")
  end
  local waypoints = plan.waypoints_deg
  local count = type(waypoints) == "table" and #waypoints or 0
  if count < 2 then refuse("waypoints_deg", count .. " waypoints", "2 or more", "plan a way, not only its end (--waypoints)") end
  local steps = {}
  for i, waypoint_deg in ipairs(waypoints) do steps[i] = step_to(i, count, waypoint_deg) end
  return check.mission("plan", steps)
end
