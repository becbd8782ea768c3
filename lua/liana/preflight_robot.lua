-- Checks a mission against the robot that shall do it, before anything moves.
local preflight_requests = require "liana.preflight_requests"
local check = require "liana.check"
local did_you_mean = require "liana.did_you_mean"
local plan_step = require "liana.plan_step"
local refuse = require "liana.refuse"
local action_requirements = require "liana.action_requirements"
local transitions = require "liana.transitions"

-- `where` with the line of the call at `at`, where that is known, in place of the step's own.
local function at_call(where, at, own)
  if at == nil or at == "" then return where end
  return at .. where:sub(#own + 1)
end

local function has_pose(where, field, name, robot)
  if name == nil or robot.named_poses_deg[name] ~= nil then return end
  local known = {}
  for each in pairs(robot.named_poses_deg) do known[#known + 1] = each end
  local allowed = table.concat(known, ", ") .. " (robot " .. robot.name .. ")" .. did_you_mean(name, known)
  refuse(where, field, "pose " .. tostring(name), allowed, "name one of them or add the pose")
end

local function condition_suits(where, field, condition, own, robot)
  for _, pose in ipairs(condition.poses or {}) do has_pose(at_call(where, pose.at, own), field, pose.name, robot) end
end

-- Raises what lianad would refuse about a command.
local function accepted(where, robot, refusal_of, command, fields)
  local refusal = refusal_of(command, fields)
  if refusal then error(("%s: %s (robot %s)"):format(where, refusal, robot.name), 0) end
end

local function action_suits(where, field, action, own, robot, refusal_of)
  local use = action_requirements.of(action)
  where = at_call(where, use.at, own)
  has_pose(where, field, use.pose, robot)
  if use.is_for_cables and robot.kind == "serial" then
    refuse(where, field, use.action, "for cable arms only (robot " .. robot.name .. ")", "use move_path, or a cable arm")
  end
  if not use.command then return end
  local fields = { goal_deg = use.pose and robot.named_poses_deg[use.pose] }
  for key, value in pairs(use.fields) do fields[key] = value end
  accepted(("%s: %s: %s"):format(where, field, use.action), robot, refusal_of, use.command, fields)
end

local kTipValues = 6 -- position and attitude, which the tip keeps while angles go to where they are held

local function holds_fit(where, hold, robot)
  local held, angles = 0, robot.segments and 2 * #robot.segments + (robot.base and 2 or 0) or #robot.joints
  for _ in pairs(hold) do held = held + 1 end
  local most = math.max(0, angles - kTipValues)
  if held <= most then return end
  refuse(where, "hold", held .. (held == 1 and " angle" or " angles"),
    ("at most %d (robot %s has %d angles, of which its tip needs %d)"):format(most, robot.name, angles, kTipValues),
    "hold fewer, or turn the angles with move_jp")
end

-- The list `hold` of move_cp, which holds in place of what the step does.
local function held_on_the_way_fit(where, list, robot)
  local hold = {}
  for _, held in ipairs(list) do
    if hold[held.theta] then refuse(where, "hold", "theta " .. held.theta .. " twice", "every angle once", "leave one out") end
    hold[held.theta] = held.target_deg
  end
  holds_fit(where, hold, robot)
end

-- What a function of the script's own asks for without looking at the arm is looked at like an action's.
local function what_is_asked_suits(where, step, robot, refusal_of, attempt)
  step.asks = preflight_requests.of(step.run, robot, attempt)
  for _, ask in ipairs(step.asks) do
    local where_asked = ("%s: run: %s"):format(at_call(where, ask.at, step.at), ask.action)
    accepted(where_asked, robot, refusal_of, ask.command, ask.fields)
    if preflight_requests.is_goal(ask) then
      step.goal = ask
      held_on_the_way_fit(where_asked, ask.fields.hold or {}, robot)
    end
  end
end

local function step_suits(where, step, robot, refusal_of, attempt)
  for theta, target_deg in pairs(step.hold) do
    local held = { { theta = theta, target_deg = target_deg } }
    accepted(("%s: hold[%s]"):format(where, theta), robot, refusal_of, "hold_theta", { held = held })
  end
  holds_fit(where, step.hold, robot)
  if step.device ~= "none" then
    accepted(where .. ": teleoperate", robot, refusal_of, "use_device", check.use_of(step))
  end
  action_suits(where, "run", step.run, step.at, robot, refusal_of)
  if step.plan == nil then what_is_asked_suits(where, step, robot, refusal_of, attempt) end
  for _, field in ipairs { "enter", "fail_when", "exit" } do condition_suits(where, field, step[field], step.at, robot) end
  for _, way in ipairs(step.ways) do
    if way.when then condition_suits(where, "next", way.when, step.at, robot) end
  end
end

-- Where a step leaves the arm, as far as that is known before: the angles of an action, or the end of a plan.
local function end_of(step, robot)
  local use = action_requirements.of(step.run)
  return step.goal_deg or use.pose and robot.named_poses_deg[use.pose] or use.command == "move_jp" and use.fields.goal_deg or nil
end

-- A plan begins where the steps before it end.
local function leads_to_plans(mission, i, robot)
  local step, before = mission.steps[i], end_of(mission.steps[i], robot)
  for _, target in ipairs(before and transitions.followers(mission.steps, i) or {}) do
    local plan = mission.steps[target]
    for theta, start_deg in ipairs(plan and plan.start_deg or {}) do
      if math.abs(start_deg - before[theta]) > plan_step.kAtStart_deg then
        refuse(check.step_where(mission, target), "plan", ("begins with theta %d at %g deg"):format(theta, start_deg),
          ("within %g deg of %g, where step %d \"%s\" ends"):format(plan_step.kAtStart_deg, before[theta], i, step.name),
          "go to the plan's start first, or plan from there")
      end
    end
  end
end

-- Refuses what this robot (docs/reference/formats.md) cannot do: angles and nodes it does not have, targets beyond its
-- limits, poses it does not know. refusal_of(command, fields) says what lianad would refuse, or nothing. With `attempt`
-- (pcall with a budget of its own) functions of steps are called once to find what they ask for, in a script that runs
-- nothing afterwards. `asks` of a step is what is found, `goal` the goal among it.
return function(mission, robot, refusal_of, attempt)
  local called = "mission " .. mission.name
  for i, step in ipairs(mission.steps) do
    step_suits(check.step_where(mission, i), step, robot, refusal_of, attempt)
  end
  for i in ipairs(mission.steps) do leads_to_plans(mission, i, robot) end
  action_suits(mission.at .. called, "finish", mission.finish, mission.at, robot, refusal_of)
end
