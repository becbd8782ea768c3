-- Where a step's `run` wants the arm to go, as far as that is known before anything moves: what an action says, and what a
-- function of arm asks for before it looks at anything but the robot. Computed goals stay for their time.
local position = require "liana.position"
local uses = require "liana.uses"
local view = require "liana.view"

local goals = {}

local kGoalOf = { move_jp = "goal_deg", move_cp = "goal" } -- command -> its field

local function is_known(fields, field) return type(fields) == "table" and type(fields[field]) == "table" and fields[field][1] ~= nil end

-- Of an action: { action, command, fields, at }, or nothing.
local function said(action, robot)
  local use = uses.of(action)
  if use.pose then return { action = use.action, command = use.command, fields = { goal_deg = robot.named_poses_deg[use.pose] }, at = use.at } end
  return kGoalOf[use.command] and use or nil
end

-- What an arm does with a command while nothing moves: a goal is remembered and ends the look, what goes beside one is passed over.
local function listening(remember)
  local function goal_of(command)
    return function(fields)
      if is_known(fields, kGoalOf[command]) then remember { action = command, command = command, fields = fields, at = position(1) } end
      error("heard", 0)
    end
  end
  local commands = { move_jp = goal_of "move_jp", move_cp = goal_of "move_cp", hold_theta = function() end, shape = function() end }
  return setmetatable(commands, { __index = function(_, name) error(name .. ": not known yet", 0) end })
end

-- Of a function: the first goal that it asks an arm for of which only the robot is known. Looking at anything else ends it.
local function asked_for(run, robot, attempt)
  local goal
  local arm = view.new(listening(function(heard) goal = heard end), { robot = robot })
  arm.begin_tick, arm.was_engaged, arm.must_hold = nil, nil, nil
  attempt(run, arm)
  return goal
end

-- What `run` asks for first: { action, command, fields, at }, or nothing. With `attempt`, which is pcall with a budget of its own, a
-- function of the script's own is called to find out.
function goals.of(run, robot, attempt)
  return said(run, robot) or attempt and uses.of(run).command == nil and asked_for(run, robot, attempt) or nil
end

return goals
