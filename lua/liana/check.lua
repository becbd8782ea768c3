-- Checks a mission's structure before anything moves; every refusal says where the step stands, step, field, value, what
-- is allowed and what to do. What the robot cannot do is liana.preflight_robot's.
local did_you_mean = require "liana.did_you_mean"
local refuse = require "liana.refuse"
local retired = require "liana.retired_names"
local step_fields = require "liana.step_fields"
local action_requirements = require "liana.action_requirements"
local transitions = require "liana.transitions"

local check = {}

local kFeedbacks = { aligned = true, claim = true, abstract = true, off = true }
local kOnFail = { retract = true, hold = true, stop = true, pause = true }
local kDefaultEnterLimit_s = 10

local function is_condition(value) return type(value) == "table" and type(value.met) == "function" and type(value.text) == "string" end

local function seconds_up_to(most_s)
  return { allowed = "seconds over 0, up to " .. most_s, ok = function(v) return type(v) == "number" and v > 0 and v <= most_s end }
end

local function text_up_to(most)
  local function ok(v) return type(v) == "string" and #v >= 1 and #v <= most end
  return { allowed = ("a text of 1 to %d bytes"):format(most), ok = ok }
end

local function one_of(words, text)
  return { allowed = text, ok = function(v) return words[v] == true end }
end

-- A kind of device, `none`, or what a device may be called.
local function is_device(v) return type(v) == "string" and #v <= 31 and v:find("^[%w_.-]+$") ~= nil end

local condition_rule = { allowed = "a condition, such as at_rest() or all { ... }", ok = is_condition }
local action_rule = { allowed = "an action such as move_to \"prepare\", or a function of arm", ok = function(v) return type(v) == "function" end }

-- What the entries may be depends on the robot: check.against asks lianad's own table of requests.
local function is_table(value) return type(value) == "table" end

local function is_choice(value)
  if type(value) ~= "table" then return type(value) == "boolean" end
  local count = 0
  for _ in pairs(value) do count = count + 1 end
  for i = 1, count do
    if type(value[i]) ~= "string" then return false end
  end
  return true
end

local kStep = {
  at = { allowed = "nothing", ok = function(v) return type(v) == "string" end }, -- where it stands, noted by liana.step
  name = { allowed = "a text of 1 to 60 bytes", ok = function(v) return type(v) == "string" and #v >= 1 and #v <= 60 end, required = true },
  device = { allowed = "\"vr\", \"hand\", \"pointer\", \"none\" or the name of a device", ok = is_device, required = true },
  exit = condition_rule,
  time_limit_s = { allowed = "seconds over 0, up to 3600", ok = seconds_up_to(3600).ok, required = true },
  on_fail = { allowed = "\"retract\", \"hold\", \"stop\" or \"pause\"", ok = one_of(kOnFail).ok, required = true },
  enter = condition_rule,
  enter_limit_s = seconds_up_to(3600),
  fail_when = condition_rule,
  hold = { allowed = "{ [theta] = degrees }, such as { [9] = 0 }", ok = is_table },
  teleoperate = { allowed = "a table with fields of use_device, such as { scale = 4 }", ok = is_table },
  fixtures = { allowed = "true, false or a list of names of the scene's fixtures", ok = is_choice },
  feedback = { allowed = "\"aligned\", \"claim\", \"abstract\" or \"off\"", ok = one_of(kFeedbacks).ok },
  run = action_rule,
  plan = text_up_to(200),
  next = { allowed = "ways, such as \"name\" or { step = \"name\", when = condition }", ok = function(v) return v ~= nil end },
  confirm = text_up_to(80),
  task = text_up_to(40),
}

-- A step's name in messages, behind where it stands in the script; `mission` is that of the mission.
function check.where_of(mission, step)
  local name = type(step.name) == "string" and " \"" .. step.name .. "\"" or ""
  return (type(step.at) == "string" and step.at or "") .. mission .. name
end

-- What a device's operator can be told to do; any recording's name for `vr`.
local kHandTasks = { slit = true, rod = true }

local function check_task(where, fields)
  if fields.task == nil then return end
  if fields.device ~= "vr" and fields.device ~= "hand" then
    refuse(where, "task", fields.task, "only with device vr or hand", "name the device or remove task")
  end
  if fields.device == "hand" and not kHandTasks[fields.task] then
    refuse(where, "task", fields.task, "\"slit\" or \"rod\" for device hand", "name one of them or remove task")
  end
  if fields.device == "vr" and not fields.task:find("^[%w_-]+$") then
    refuse(where, "task", fields.task, "the name of a recording: letters, digits, _ and -", "correct the name")
  end
end

-- What a plan says itself, and what needs it.
local function check_plan(where, fields)
  if fields.plan == nil then
    if fields.exit == nil then refuse(where, "exit", "missing", condition_rule.allowed, "add the field") end
    return
  end
  for _, field in ipairs { "run", "exit" } do
    if fields[field] ~= nil then refuse(where, field, "given", "nothing beside plan, which says it", "remove it, or make it a step of its own") end
  end
  if fields.device ~= "none" then refuse(where, "device", fields.device, "\"none\" beside plan", "correct the device") end
end

local function field_names()
  local names = {}
  for i, field in ipairs(step_fields) do names[i] = field[1] end
  return names
end

local function no_such_field(where, shown, field, value, names)
  local allowed = "no such field, but " .. table.concat(names, ", ") .. did_you_mean(field, names)
  refuse(where, shown, value, allowed, "remove it or correct its spelling")
end

local function check_step(where, fields)
  if type(fields) ~= "table" then refuse(where, "step", fields, "step \"name\" { ... }", "write the step with step") end
  where = check.where_of(where, fields)
  for field, value in pairs(fields) do
    local rule = kStep[field]
    if not rule then
      no_such_field(where, tostring(field) .. retired.hint("step", field), field, value, field_names())
    end
    if not rule.ok(value) then refuse(where, field, value, rule.allowed, "correct the step") end
  end
  for field, rule in pairs(kStep) do
    if rule.required and fields[field] == nil then refuse(where, field, "missing", rule.allowed, "add the field") end
  end
  for _, field in ipairs { "teleoperate", "fixtures", "feedback" } do
    if fields[field] ~= nil and fields.device == "none" then
      refuse(where, field, "given", "only with a device", "name the device or remove " .. field)
    end
  end
  for _, field in ipairs { "device", "fixtures", "feedback" } do
    local value = fields.teleoperate and fields.teleoperate[field]
    if value ~= nil then refuse(where, "teleoperate." .. field, value, "nothing", "name the " .. field .. " in the step's own field") end
  end
  check_task(where, fields)
  check_plan(where, fields)
end

-- The step with defaults.
local function filled_in(fields)
  local step = {
    teleoperate = {}, run = function() end, enter_limit_s = kDefaultEnterLimit_s,
    enter = { text = "none", met = function() return true end }, fail_when = { text = "never", met = function() return false end },
    at = "",
  }
  for field, value in pairs(fields) do step[field] = value end
  step.enters_when = fields.enter
  return step
end

-- Step `number` of a checked mission in messages.
function check.step_where(mission, number)
  return check.where_of(("mission %s: step %d"):format(mission.name, number), mission.steps[number])
end

-- What depends on the steps together: what comes after each, and what each holds.
local function settle(mission)
  local function where_of(i) return check.step_where(mission, i) end
  transitions.resolve(mission.steps, where_of)
  transitions.settle_holds(mission.steps, where_of)
  for i, step in ipairs(mission.steps) do
    for _ in pairs(step.plan and step.hold or {}) do
      refuse(where_of(i), "hold", "something held", "{} beside plan, which turns every angle", "write hold = {}")
    end
  end
end

-- The fields with which a checked step's device is used.
function check.use_of(step)
  local fields = { device = step.device, feedback = step.feedback }
  for field, value in pairs(step.teleoperate) do fields[field] = value end
  if step.fixtures == false then fields.fixtures = {} end
  if type(step.fixtures) == "table" then fields.fixtures = step.fixtures end
  return fields
end

local function is_name(v) return type(v) == "string" and v:find("^[%w_-]+$") ~= nil end

local table_rule = { allowed = "the name of a table: letters, digits, _ and -", ok = is_name }

-- What a mission says beside its steps: what is done at the end, and the tables that it runs with where nobody names others.
local kMission = { finish = action_rule, robot = table_rule, scene = table_rule, bus = table_rule }

local function check_mission_field(where, fields, key)
  local rule, value = kMission[key], fields[key]
  if not rule then no_such_field(where, tostring(key), key, value, { "bus", "finish", "robot", "scene" }) end
  if not rule.ok(value) then refuse(where, key, value, rule.allowed, "correct the field") end
  if key == "bus" and fields.robot == nil then
    refuse(where, "bus", value, "only beside robot, whose drives are on it", "name the robot or remove bus")
  end
end

local checked = {} -- missions by what scripts have in their place

local function copy_of(value)
  if type(value) ~= "table" then return value end
  local copy = {}
  for key, each in pairs(value) do copy[key] = copy_of(each) end
  return copy
end

local sealed = { __metatable = false, __newindex = function() error("a mission is read-only: write its fields where it is made", 2) end }

-- Stands for a checked mission { name, steps, finish, at, tables }; raises a message on the first fault. `at`: where it stands in the
-- script.
function check.mission(name, fields, at)
  local called = "mission " .. tostring(name)
  local where = at .. called
  if not is_name(name) then
    refuse(at .. "mission", "name", name, "letters, digits, _ and -", "choose another name")
  end
  if type(fields) ~= "table" then refuse(where, "steps", fields, "a table of steps", "write mission \"name\" { step ... }") end
  fields = copy_of(fields) -- what a script changes later is not what was checked
  local mission = { name = name, at = at, steps = {}, finish = fields.finish or function() end }
  for key in pairs(fields) do
    if math.type(key) ~= "integer" then check_mission_field(where, fields, key) end
  end
  mission.tables = { robot = fields.robot, scene = fields.scene, bus = fields.bus }
  for i, step in ipairs(fields) do
    check_step(called .. ": step " .. i, step)
    mission.steps[i] = filled_in(step)
  end
  if #mission.steps == 0 then refuse(where, "steps", "none", "at least one step", "add a step") end
  settle(mission)
  local handle = setmetatable({}, sealed)
  checked[handle] = mission
  return handle
end

-- The mission for which stands what a file returned; refuses anything else.
function check.opened(mission)
  if checked[mission] then return checked[mission] end
  refuse("mission", "file", type(mission), "return liana.mission \"name\" { ... }", "return the mission at the end of the file")
end

local function sorted_held(hold)
  local held = {}
  for theta in pairs(hold) do held[#held + 1] = theta end
  return held
end

local function described_ways(step)
  local out = {}
  for i, way in ipairs(step.ways) do
    out[i] = { step = way.step, when = way.when and way.when.text, on = way.on, at_most = way.at_most }
  end
  return out
end

-- What the conditions of a step look at in the scene: { part, field, at }.
local function described_parts(step)
  local out = {}
  local function add(field, condition)
    for _, part in ipairs(condition and condition.parts or {}) do out[#out + 1] = { part = part.name, field = field, at = part.at } end
  end
  for _, field in ipairs { "enter", "fail_when", "exit" } do add(field, step[field]) end
  for _, way in ipairs(step.ways) do add("next", way.when) end
  return out
end

-- The commands that a step is known to give, as liana.preflight_robot has found them.
local function described_asks(step)
  local out = {}
  for i, ask in ipairs(step.asks or {}) do out[i] = ask.command end
  return out
end

-- A list of { theta, target_deg } as commands have it, of what a step holds.
local function held_list(hold)
  local held = {}
  for theta, target_deg in pairs(hold) do held[#held + 1] = { theta = theta, target_deg = target_deg } end
  return held
end

-- What is allowed, and may yet not be what was meant.
local function notes_of(mission)
  local notes, first = {}, {}
  for i, step in ipairs(mission.steps) do
    local where, earlier = check.step_where(mission, i), first[step.name]
    if step.name == transitions.kFinish then notes[#notes + 1] = where .. ": in next, that name is the end of the mission" end
    if earlier then
      notes[#notes + 1] = ("%s: step %d has that name, too: no next can lead to either of them"):format(where, earlier)
    end
    first[step.name] = earlier or i
  end
  return notes
end

-- The tables that a mission says it runs with: robot, scene, bus, each where it says one.
function check.tables(mission)
  return { format = 1, kind = "mission_tables", robot = mission.tables.robot, scene = mission.tables.scene, bus = mission.tables.bus }
end

-- Plain data about a mission, for `liana-mission eval mission`.
function check.describe(mission)
  local steps = {}
  for i, step in ipairs(mission.steps) do
    local goal = step.goal or { fields = {} } -- as liana.preflight_robot has found it
    steps[i] = {
      name = step.name, device = step.device, held_theta = sorted_held(step.hold), time_limit_s = step.time_limit_s,
      on_fail = step.on_fail, confirm = step.confirm, task = step.task, at = step.at, enter = step.enter.text, exit = step.exit.text,
      fail_when = step.fail_when.text, next = described_ways(step), plan = step.plan, start_deg = step.start_deg,
      goal_deg = step.goal_deg or goal.fields.goal_deg, goal_pose = action_requirements.of(step.run).pose, goal_tip = goal.fields.goal,
      goal_hold = goal.fields.hold or held_list(step.hold), goal_at = goal.at, parts = described_parts(step),
      asks = described_asks(step),
      fixtures = type(step.fixtures) == "table" and #step.fixtures > 0 and step.fixtures or nil,
    }
  end
  return { format = 1, kind = "mission", name = mission.name, steps = steps, notes = notes_of(mission) }
end

return check
