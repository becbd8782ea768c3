-- A plan of `liana plan --out` as a mission of one step: the arm goes through the waypoints on one time law, at rest at
-- the ends only, which is the way that the planner has checked (docs/planning.md). It has to stand at the start of the
-- plan: the way from anywhere else is not checked.
local check = require "liana.check"
local conditions = require "liana.conditions"
local uses = require "liana.uses"

local kAtStart_deg = 1.0 -- of every theta from the first waypoint
local kArrived_deg = 0.02
local kTimeLimit_s = 3600 -- lianad refuses longer paths
local kLeastMargin_m = 0.001 -- which the motion may use up

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

local path_ended = conditions.condition("path ended", function(arm) return arm.state.path == nil end)

-- Short enough for a request: 1e-7 deg are 20 nm at the tip.
local function rounded(waypoints_deg)
  local out = {}
  for k, waypoint_deg in ipairs(waypoints_deg) do
    out[k] = {}
    for i, angle_deg in ipairs(waypoint_deg) do out[k][i] = math.floor(angle_deg * 1e7 + 0.5) / 1e7 end
  end
  return out
end

-- The checked mission of a plan (docs/formats.md).
return function(plan)
  if type(plan) ~= "table" or plan.outcome ~= "solved" then
    local found = type(plan) == "table" and plan.outcome or plan
    refuse("outcome", found, "solved", "give a file that liana plan --out has written")
  end
  local waypoints = plan.waypoints_deg
  local count = type(waypoints) == "table" and #waypoints or 0
  if count < 2 then
    refuse("waypoints_deg", count .. " waypoints", "2 or more", "plan a way, not only its end (--waypoints)")
  end
  local margin_m = math.max(kLeastMargin_m, plan.inputs and plan.inputs.margin_m or 0)
  local fields = { points_deg = rounded(waypoints), margin_m = margin_m }
  local name = ("plan, %d waypoints"):format(count)
  local at_start = ("arm within %g deg of the plan's start"):format(kAtStart_deg)
  return check.mission("plan", { {
    name = name, device = "none", time_limit_s = kTimeLimit_s, on_fail = "hold",
    enter = within(waypoints[1], kAtStart_deg, at_start),
    run = uses.noted(function(arm) arm.move_path(fields) end, { action = name, command = "move_path", fields = fields }),
    exit = conditions.all {
      within(waypoints[count], kArrived_deg, "at the last waypoint"), path_ended, conditions.at_rest(),
    },
  } })
end
