-- Checks a mission's structure before anything moves; every refusal says step, field, value, what is allowed and what to do.
local uses = require "liana.uses"

local check = {}

local kDevices = { vr = true, hand = true, none = true }
local kOnFail = { retract = true, hold = true, stop = true, pause = true }
local kDefaultEnterLimit_s = 10

local function refuse(where, field, value, allowed, advice)
  error(where .. ": " .. field .. ": " .. tostring(value) .. ": allowed " .. allowed .. ": " .. advice, 0)
end

local function is_condition(value) return type(value) == "table" and type(value.met) == "function" end

local function seconds_up_to(most_s)
  return { allowed = "seconds over 0, up to " .. most_s, ok = function(v) return type(v) == "number" and v > 0 and v <= most_s end }
end

local function one_of(words, text)
  return { allowed = text, ok = function(v) return words[v] == true end }
end

local condition_rule = { allowed = "a condition, such as at_rest() or all { ... }", ok = is_condition }
local action_rule = { allowed = "an action such as move_to \"prepare\", or a function of arm", ok = function(v) return type(v) == "function" end }

-- What the entries may be depends on the robot: check.against asks lianad's own table of requests.
local function is_table(value) return type(value) == "table" end

local kStep = {
  name = { allowed = "a text of 1 to 60 bytes", ok = function(v) return type(v) == "string" and #v >= 1 and #v <= 60 end, required = true },
  device = { allowed = "\"vr\", \"hand\" or \"none\"", ok = one_of(kDevices).ok, required = true },
  exit = { allowed = condition_rule.allowed, ok = is_condition, required = true },
  time_limit_s = { allowed = "seconds over 0, up to 3600", ok = seconds_up_to(3600).ok, required = true },
  on_fail = { allowed = "\"retract\", \"hold\", \"stop\" or \"pause\"", ok = one_of(kOnFail).ok, required = true },
  enter = condition_rule,
  enter_limit_s = seconds_up_to(3600),
  hold = { allowed = "{ [theta] = degrees }, such as { [9] = 0 }", ok = is_table },
  steer = { allowed = "a table with fields of use_device, such as { scale = 4 }", ok = is_table },
  run = action_rule,
  confirm = { allowed = "a text of 1 to 80 bytes", ok = function(v) return type(v) == "string" and #v >= 1 and #v <= 80 end },
  task = { allowed = "a text of 1 to 40 bytes", ok = function(v) return type(v) == "string" and #v >= 1 and #v <= 40 end },
}

local function check_step(where, fields)
  if type(fields) ~= "table" then refuse(where, "step", fields, "step \"name\" { ... }", "write the step with step") end
  if type(fields.name) == "string" then where = where .. " \"" .. fields.name .. "\"" end
  for field, value in pairs(fields) do
    local rule = kStep[field]
    if not rule then refuse(where, tostring(field), value, "no such field", "remove it or correct its spelling") end
    if not rule.ok(value) then refuse(where, field, value, rule.allowed, "correct the step") end
  end
  for field, rule in pairs(kStep) do
    if rule.required and fields[field] == nil then refuse(where, field, "missing", rule.allowed, "add the field") end
  end
  if fields.steer and fields.device == "none" then
    refuse(where, "steer", "given", "only with device vr or hand", "name the device or remove steer")
  end
  if fields.steer and fields.steer.device then
    refuse(where, "steer.device", fields.steer.device, "nothing", "name the device in the step's own field")
  end
end

-- The step with defaults; what it holds is what the step before held unless it says otherwise.
local function filled_in(fields, held_before)
  local step = {
    hold = held_before, steer = {}, run = function() end, enter_limit_s = kDefaultEnterLimit_s,
    enter = { text = "none", met = function() return true end },
  }
  for field, value in pairs(fields) do step[field] = value end
  return step
end

-- A checked mission { name, steps, finish }; raises a message without position on the first fault.
function check.mission(name, fields)
  local where = "mission " .. tostring(name)
  if type(name) ~= "string" or not name:find("^[%w_-]+$") then refuse("mission", "name", name, "letters, digits, _ and -", "choose another name") end
  if type(fields) ~= "table" then refuse(where, "steps", fields, "a table of steps", "write mission \"name\" { step ... }") end
  local mission = { is_mission = true, name = name, steps = {}, finish = fields.finish or function() end }
  for key, value in pairs(fields) do
    if key == "finish" then
      if type(value) ~= "function" then refuse(where, "finish", value, action_rule.allowed, "correct the field") end
    elseif math.type(key) ~= "integer" then
      refuse(where, tostring(key), value, "no such field", "remove it or correct its spelling")
    end
  end
  for i, step in ipairs(fields) do
    check_step(where .. ": step " .. i, step)
    mission.steps[i] = filled_in(step, i > 1 and mission.steps[i - 1].hold or {})
  end
  if #mission.steps == 0 then refuse(where, "steps", "none", "at least one step", "add a step") end
  return mission
end

local function require_mission(mission)
  if type(mission) == "table" and mission.is_mission == true then return end
  refuse("mission", "file", type(mission), "return liana.mission \"name\" { ... }", "return the mission at the end of the file")
end

local function has_poses(where, field, names, robot)
  local known = {}
  for name in pairs(robot.named_poses_deg) do known[#known + 1] = name end
  for _, name in ipairs(names) do
    if robot.named_poses_deg[name] == nil then
      local allowed = table.concat(known, ", ") .. " (robot " .. robot.name .. ")"
      refuse(where, field, "pose " .. tostring(name), allowed, "name one of them or add the pose")
    end
  end
end

-- Raises what lianad would refuse about a command.
local function accepted(where, robot, refusal_of, command, fields)
  local refusal = refusal_of(command, fields)
  if refusal then error(("%s: %s (robot %s)"):format(where, refusal, robot.name), 0) end
end

local function action_suits(where, field, action, robot, refusal_of)
  local use = uses.of(action)
  has_poses(where, field, { use.pose }, robot)
  if not use.command then return end
  local fields = { goal_deg = use.pose and robot.named_poses_deg[use.pose] }
  for key, value in pairs(use.fields) do fields[key] = value end
  accepted(("%s: %s: %s"):format(where, field, use.action), robot, refusal_of, use.command, fields)
end

local kTipValues = 6 -- position and attitude, which the tip keeps while angles go to where they are held

local function holds_fit(where, hold, robot)
  local held, angles = 0, robot.segments and 2 * #robot.segments or #robot.joints
  for _ in pairs(hold) do held = held + 1 end
  local most = math.max(0, angles - kTipValues)
  if held <= most then return end
  refuse(where, "hold", held .. (held == 1 and " angle" or " angles"),
    ("at most %d (robot %s has %d angles, of which its tip needs %d)"):format(most, robot.name, angles, kTipValues),
    "hold fewer, or turn the angles with move_jp")
end

local function step_suits(where, step, robot, refusal_of)
  for theta, target_deg in pairs(step.hold) do
    local held = { { theta = theta, target_deg = target_deg } }
    accepted(("%s: hold[%s]"):format(where, theta), robot, refusal_of, "hold_theta", { held = held })
  end
  holds_fit(where, step.hold, robot)
  if step.device ~= "none" then
    local fields = { device = step.device }
    for field, value in pairs(step.steer) do fields[field] = value end
    accepted(where .. ": steer", robot, refusal_of, "use_device", fields)
  end
  has_poses(where, "enter", step.enter.poses or {}, robot)
  action_suits(where, "run", step.run, robot, refusal_of)
  has_poses(where, "exit", step.exit.poses or {}, robot)
end

-- Refuses what this robot (docs/formats.md) cannot do: angles and nodes it does not have, targets beyond its limits, poses
-- it does not know. refusal_of(command, fields) says what lianad would refuse, or nothing.
function check.against(mission, robot, refusal_of)
  require_mission(mission)
  local where = "mission " .. mission.name
  for i, step in ipairs(mission.steps) do
    step_suits(where .. ": step " .. i .. " \"" .. step.name .. "\"", step, robot, refusal_of)
  end
  action_suits(where, "finish", mission.finish, robot, refusal_of)
end

local function sorted_held(hold)
  local held = {}
  for theta in pairs(hold) do held[#held + 1] = theta end
  return held
end

-- Plain data about a mission, for `liana-mission eval mission`.
function check.describe(mission)
  require_mission(mission)
  local steps = {}
  for i, step in ipairs(mission.steps) do
    steps[i] = {
      name = step.name, device = step.device, held_theta = sorted_held(step.hold), time_limit_s = step.time_limit_s,
      on_fail = step.on_fail, confirm = step.confirm, enter = step.enter.text, exit = step.exit.text,
    }
  end
  return { format = 1, kind = "mission", name = mission.name, steps = steps }
end

return check
