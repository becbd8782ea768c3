-- Conditions for `enter`, `exit` and `fail_when` of steps. A condition is { text, met(arm) -> boolean, what of it is met };
-- the text appears when it is not met in time, and what is met when it ends a step.
-- `arm` is that of lua/liana/arm_state.lua: the last state, the scene, the robot, and what happened since the step began.
local geometry = require "liana.geometry"
local check_argument = require "liana.check_argument"
local position = require "liana.position"
local format_value = require "liana.format_value"

local conditions = {}

local kPathEnd_deg = 0.02 -- of every joint from the end of a path

-- A condition of your own: what it says, and a function of arm that returns true when it is met, else false or nothing.
function conditions.condition(text, met)
  check_argument("condition", "text", text, "string")
  check_argument("condition", "met", met, "function")
  return { text = text, met = function(arm)
    local is_met = met(arm)
    if is_met ~= nil and type(is_met) ~= "boolean" then
      local what = 'condition "%s": its function returned %s: allowed true, false or nothing: compare it with something'
      error(what:format(text, format_value(is_met)), 0)
    end
    if is_met then return true, text end
    return false
  end }
end

local condition = conditions.condition

-- The same, remembering which named pose of the robot it uses; a mission is checked for it before it starts.
local function condition_on(name, at, text, met)
  local made = condition(text, met)
  made.poses = { { name = name, at = at } }
  return made
end

-- The same, remembering which part of the scene it looks at ("rod", "slit", "payload").
local function condition_in(part, at, text, met)
  local made = condition(text, met)
  made.parts = { { name = part, at = at } }
  return made
end

local function need_conditions(what, list)
  check_argument(what, "list", list, "table")
  if #list == 0 then error(what .. ": list: empty: allowed one condition or more, such as at_rest(): correct the call", 3) end
  for i, each in ipairs(list) do
    if type(each) ~= "table" or type(each.met) ~= "function" then
      error(("%s: entry %d: %s: allowed conditions, such as at_rest(): correct the call"):format(what, i, tostring(each)), 3)
    end
  end
end

-- What the conditions of a list remember under `key`.
local function remembered(list, key)
  local out = {}
  for _, each in ipairs(list) do
    for _, one in ipairs(each[key] or {}) do out[#out + 1] = one end
  end
  return out
end

local function texts(list, word)
  local out = {}
  for i, each in ipairs(list) do out[i] = each.text end
  return table.concat(out, word)
end

-- Met when all of the list are.
function conditions.all(list)
  need_conditions("all", list)
  return { text = texts(list, " and "), poses = remembered(list, "poses"), parts = remembered(list, "parts"), met = function(arm)
    local met = {}
    for i, each in ipairs(list) do
      local is_met, what = each.met(arm)
      if not is_met then return false end
      met[i] = what or each.text
    end
    return true, table.concat(met, " and ")
  end }
end

-- Met when one of the list is: the first that is met is named.
function conditions.any(list)
  need_conditions("any", list)
  return { text = texts(list, " or "), poses = remembered(list, "poses"), parts = remembered(list, "parts"), met = function(arm)
    for _, each in ipairs(list) do
      local is_met, what = each.met(arm)
      if is_met then return true, what or each.text end
    end
    return false
  end }
end

-- The arm stands still.
function conditions.at_rest()
  return condition("arm at rest", function(arm) return arm.state.at_rest and not arm.state.is_busy end)
end

-- The tool has carried out its last command.
function conditions.tool_done()
  return condition("tool done", function(arm) return arm.state.tool ~= nil and arm.state.tool.phase == "done" end)
end

local kTipGoal_m = 0.001 -- of the tip from a goal in the base frame
local kTipGoal_deg = 0.1 -- of its attitude
local kTipValues = 7 -- x, y, z and a quaternion

local function is_at_joints(arm, goal_deg)
  for i, target_deg in ipairs(goal_deg) do
    if math.abs(arm.state.setpoint_js_deg[i] - target_deg) > kPathEnd_deg then return false end
  end
  return true
end

local function is_at_tip(arm, goal)
  local tip, along = arm.state.setpoint_cp, 0
  for i = 4, kTipValues do along = along + tip[i] * goal[i] end
  local angle_deg = math.deg(2 * math.acos(math.min(1, math.abs(along))))
  return geometry.distance({ tip[1], tip[2], tip[3] }, { goal[1], goal[2], goal[3] }) <= kTipGoal_m and angle_deg <= kTipGoal_deg
end

-- The arm is at rest at the end of the curve that `follow_curve` or `follow_back` of this step goes along.
function conditions.curve_followed()
  return condition("curve followed to its end", function(arm)
    if arm.path_end_deg == nil or arm.state.path ~= nil or not arm.state.at_rest or arm.state.is_busy then return false end
    return is_at_joints(arm, arm.path_end_deg)
  end)
end

-- The arm is at rest at the goal of the last motion that this step has asked for (move_to, move_jp, move_cp, a path); not met while a
-- refusal keeps it from there, and without such a motion.
function conditions.goal_reached()
  return condition("goal reached", function(arm)
    local goal = arm.goal
    if goal == nil or arm.state.path ~= nil or not arm.state.at_rest or arm.state.is_busy then return false end
    if goal.joints_deg then return is_at_joints(arm, goal.joints_deg) end
    return is_at_tip(arm, goal.tip)
  end)
end

-- Every joint setpoint within tolerance_deg (default 0.02) of a named pose of the robot.
function conditions.at_pose(name, tolerance_deg)
  check_argument("at_pose", "name", name, "string")
  tolerance_deg = tolerance_deg or 0.02
  check_argument("at_pose", "tolerance_deg", tolerance_deg, "number over 0")
  return condition_on(name, position(1), "at pose " .. name, function(arm)
    for i, target_deg in ipairs(arm.named_pose(name)) do
      if math.abs(arm.state.setpoint_js_deg[i] - target_deg) > tolerance_deg then return false end
    end
    return true
  end)
end

-- The tip within distance_m of where a named pose puts it.
function conditions.tip_near_pose(name, distance_m)
  check_argument("tip_near_pose", "name", name, "string")
  check_argument("tip_near_pose", "distance_m", distance_m, "number over 0")
  return condition_on(name, position(1), ("tip within %g m of pose %s"):format(distance_m, name), function(arm)
    local there = geometry.tip(arm.robot, arm.named_pose(name)).position
    return geometry.distance(arm.tip(), there) <= distance_m
  end)
end

-- The tip within distance_m of the press rod.
function conditions.tip_near_rod(distance_m)
  check_argument("tip_near_rod", "distance_m", distance_m, "number over 0")
  return condition_in("rod", position(1), ("tip within %g m of the rod"):format(distance_m), function(arm)
    return geometry.distance(arm.tip_in_drawing(), arm.part_of_scene("rod").position_m) <= distance_m
  end)
end

-- The visual servo has arrived, dwelt and ended by itself.
function conditions.servo_done()
  return condition("servo done", function(arm) return arm.state.servo.phase == "done" end)
end

local kServoFailures = { lost = "target lost", timed_out = "servo timed out" }

-- The visual servo has lost its target, or did not arrive in time; the report says which.
function conditions.servo_failed()
  local text = "target lost or servo timed out"
  return { text = text, met = function(arm)
    local servo = arm.state.servo
    local failure = kServoFailures[servo.phase]
    if not failure then return false end
    return true, failure .. ": " .. servo.reason
  end }
end

-- The force on the tip is at least least_N, and known to sd_N (default 0.6) along every axis.
function conditions.tip_force(least_N, sd_N)
  check_argument("tip_force", "least_N", least_N, "number over 0")
  sd_N = sd_N or 0.6
  check_argument("tip_force", "sd_N", sd_N, "number over 0")
  if sd_N >= 1 then
    error(("tip_force: sd_N: %g: allowed over 0 and under 1, where forces are told: correct the call"):format(sd_N), 2)
  end
  return condition(("tip pushed with %g N"):format(least_N), function(arm)
    local contact, square = arm.state.contact, 0
    if not contact then error("tip_force: this arm does not feel forces: use it with a cable arm", 0) end
    for i = 1, 3 do
      if contact.sd_N[i] > sd_N then return false end
      square = square + contact.force_N[i] ^ 2
    end
    return square >= least_N ^ 2
  end)
end

-- The tip at least u_m along the slit, from the base (the mouth is at slit.mouth_u_m).
function conditions.tip_past(u_m)
  check_argument("tip_past", "u_m", u_m, "number")
  return condition_in("slit", position(1), ("tip past u = %g m"):format(u_m), function(arm) return arm.slit_u() >= u_m end)
end

-- At least the last `count` segments have to be planar (flat) now, as lianad computes from where they are at the slit's mouth.
function conditions.needs_planar(count)
  check_argument("needs_planar", "count", count, "number")
  return condition_in("slit", position(1), ("slit asks for %d planar segments"):format(count), function(arm)
    return arm.state.planar_segments >= count
  end)
end

-- The tip at most distance_m off the middle plane of the slit.
function conditions.tip_in_plane(distance_m)
  check_argument("tip_in_plane", "distance_m", distance_m, "number over 0")
  return condition_in("slit", position(1), ("tip within %g m of the slit plane"):format(distance_m), function(arm)
    return math.abs(arm.slit_offset()) <= distance_m
  end)
end

-- The joints that this step holds are held and at their targets.
function conditions.held()
  return condition("held variables at their targets", function(arm) return arm.holds_what_it_should() and arm.state.held_at_target end)
end

-- The arm has the shape that `shape` requested, or has come no nearer to it for 4 s. Its nodes may be at most missing_m [m] away (any
-- distance if not given).
function conditions.shape_settled(missing_m)
  if missing_m ~= nil then check_argument("shape_settled", "missing_m", missing_m, "number") end
  local text = missing_m and ("shape settled with at most %g m missing"):format(missing_m) or "shape settled"
  return condition(text, function(arm)
    local shape = arm.state.shape
    if not shape then error("shape_settled: this arm has no shape to steer: use it with a cable arm", 0) end
    return shape.settled and (missing_m == nil or shape.missing_m <= missing_m)
  end)
end

-- The operator has closed and opened the deadman in this step.
function conditions.released()
  return condition("device released by the operator", function(arm) return arm.was_engaged and not arm.state.device_engaged end)
end

-- The operator said `what` after this step began.
function conditions.operator_says(what)
  check_argument("operator_says", "what", what, "string")
  return condition("operator says " .. what, function(arm)
    local said = arm.state.operator_says
    return said ~= nil and said.what == what and said.tick > arm.begin_tick
  end)
end

return conditions
