-- What a step's `run` asks the arm for, as far as that is known before anything moves: what an action says, and what a
-- function of arm asks for before it looks at anything but the robot. What is computed stays for its time.
local position = require "liana.position"
local action_requirements = require "liana.action_requirements"
local arm_state = require "liana.arm_state"

local asked = {}

local kGoalOf = { move_jp = "goal_deg", move_cp = "goal" } -- command -> its field
local kBeside = { insert = true, comply = true, payload = true, adapter = true } -- no goals, but looked at like them
-- Without these a script does not know yet what it will ask for.
local kKnownBy = { payload = "mass_kg", adapter = "command" }

local function is_goal_known(fields, field)
  return type(fields) == "table" and type(fields[field]) == "table" and fields[field][1] ~= nil
end

local function is_known(command, fields)
  local field = kKnownBy[command]
  return field == nil or type(fields) == "table" and fields[field] ~= nil
end

-- Of an action: what it says, with the angles of a pose.
local function said(action, robot)
  local use = action_requirements.of(action)
  if use.pose then
    return { action = use.action, command = use.command, fields = { goal_deg = robot.named_poses_deg[use.pose] }, at = use.at }
  end
  return (kGoalOf[use.command] or kBeside[use.command]) and use or nil
end

-- What an arm does with a command while nothing moves: it is remembered. A goal ends the look; what holds or shapes the
-- arm beside one is passed over.
local function listening(found)
  local function heard(command, fields)
    found[#found + 1] = { action = command, command = command, fields = fields, at = position(2) }
  end
  local commands = { hold_theta = function() end, shape = function() end }
  for command, field in pairs(kGoalOf) do
    commands[command] = function(fields)
      if is_goal_known(fields, field) then heard(command, fields) end
      error("heard", 0)
    end
  end
  for command in pairs(kBeside) do
    commands[command] = function(fields)
      if is_known(command, fields) then heard(command, fields) end
    end
  end
  return setmetatable(commands, { __index = function(_, name) error(name .. ": not known yet", 0) end })
end

-- Of a function: what it asks an arm for of which only the robot is known. Looking at anything else ends it.
local function heard_from(run, robot, attempt)
  local found = {}
  local arm = arm_state.new(listening(found), { robot = robot })
  arm.begin_tick, arm.was_engaged, arm.must_hold = nil, nil, nil
  attempt(run, arm)
  return found
end

-- What `run` asks for, in turn: { action, command, fields, at }. With `attempt`, which is pcall with a budget of its own, a
-- function of the script's own is called to find out.
function asked.of(run, robot, attempt)
  if action_requirements.of(run).command then return { said(run, robot) } end
  return attempt and heard_from(run, robot, attempt) or {}
end

function asked.is_goal(ask) return kGoalOf[ask.command] ~= nil end

return asked
