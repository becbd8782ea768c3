-- A plan of `liana plan --out` as a step: the arm goes through the waypoints on one time law, at rest at the ends only,
-- which is the way that the planner has checked (docs/explanation/path-planning.md). It has to stand at the start of
-- the plan: the way from anywhere else is not checked.
local check = require "liana.check"
local conditions = require "liana.conditions"
local refuse = require "liana.refuse"
local action_requirements = require "liana.action_requirements"

local plan_step = { kAtStart_deg = 1.0 } -- of every theta from the first waypoint, as lianad takes a path
local kArrived_deg = 0.02
local kTimeLimit_s = 3600 -- lianad refuses longer paths
local kLeastMargin_m = 0.001 -- which the motion may use up

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

local function waypoints_of(plan, where)
  if type(plan) ~= "table" or plan.outcome ~= "solved" then
    local advice = "give a file that liana plan --out has written"
    if type(plan) == "table" and plan.points_m ~= nil then
      refuse(where, "outcome", "missing: this is a curve", "solved", "plan it: liana plan --follow=CURVE --out=PLAN, and name PLAN")
    end
    local found = type(plan) == "table" and plan.outcome or plan
    refuse(where, "outcome", found, "solved", advice)
  end
  local count = type(plan.waypoints_deg) == "table" and #plan.waypoints_deg or 0
  if count < 2 then refuse(where, "waypoints_deg", count .. " waypoints", "2 or more", "plan a way, not only its end (--waypoints)") end
  return plan.waypoints_deg, count
end

-- Gives a checked step what its plan (docs/reference/formats.md) says: where to begin, the motion, and when it is over.
local function fill(step, plan, where)
  local waypoints_deg, count = waypoints_of(plan, where)
  local margin_m = math.max(kLeastMargin_m, plan.inputs and plan.inputs.margin_m or 0)
  local fields = { points_deg = rounded(waypoints_deg), margin_m = margin_m }
  local action = ("plan, %d waypoints"):format(count)
  local at_start = within(waypoints_deg[1], plan_step.kAtStart_deg, ("arm within %g deg of the plan's start"):format(plan_step.kAtStart_deg))
  step.start_deg, step.goal_deg = waypoints_deg[1], waypoints_deg[count]
  step.enter = step.enters_when and conditions.all { step.enters_when, at_start } or at_start
  local note = { action = action, command = "move_path", fields = fields, at = step.at }
  step.run = action_requirements.noted(function(arm) arm.move_path(fields) end, note)
  step.exit = conditions.all { within(step.goal_deg, kArrived_deg, "at the last waypoint"), path_ended, conditions.at_rest() }
end

-- The files that steps of a mission name: { { step = number, file = name, where = the step in messages }, ... }.
function plan_step.files(mission)
  local files = {}
  for i, step in ipairs(mission.steps) do
    if step.plan then files[#files + 1] = { step = i, file = step.plan, where = check.step_where(mission, i) } end
  end
  return files
end

-- Gives step `number` its plan, the content of its file.
function plan_step.give(mission, number, plan) fill(mission.steps[number], plan, check.step_where(mission, number) .. ": plan") end

-- The checked mission of one plan.
function plan_step.mission(plan)
  local _, count = waypoints_of(plan, "plan")
  local name = ("plan, %d waypoints"):format(count)
  local fields = { name = name, device = "none", time_limit_s = kTimeLimit_s, on_fail = "hold", plan = "this file" }
  local mission = check.opened(check.mission("plan", { fields }, ""))
  fill(mission.steps[1], plan, "plan")
  mission.steps[1].plan = nil
  return mission
end

return plan_step
