-- Conditions for `enter` and `exit` of steps. A condition is { text, met(arm) -> boolean }; the text appears when it is not met in time.
-- `arm` is the view of lua/liana/view.lua: the last state, the scene, the robot, and what happened since the step began.
local geometry = require "liana.geometry"

local conditions = {}

-- A condition of your own: what it says, and a function of arm that returns true when it is met.
function conditions.condition(text, met) return { text = text, met = met } end

local condition = conditions.condition

local function texts(list, word)
  local out = {}
  for i, each in ipairs(list) do out[i] = each.text end
  return table.concat(out, word)
end

-- Met when all of the list are.
function conditions.all(list)
  return condition(texts(list, " and "), function(arm)
    for _, each in ipairs(list) do
      if not each.met(arm) then return false end
    end
    return true
  end)
end

-- Met when one of the list is.
function conditions.any(list)
  return condition(texts(list, " or "), function(arm)
    for _, each in ipairs(list) do
      if each.met(arm) then return true end
    end
    return false
  end)
end

-- The arm stands still.
function conditions.at_rest()
  return condition("arm at rest", function(arm) return arm.state.at_rest and not arm.state.is_busy end)
end

-- Every joint setpoint within tolerance_deg (default 0.02) of a named pose of the robot.
function conditions.at_pose(name, tolerance_deg)
  tolerance_deg = tolerance_deg or 0.02
  return condition("at pose " .. name, function(arm)
    for i, target_deg in ipairs(arm.named_pose(name)) do
      if math.abs(arm.state.setpoint_js_deg[i] - target_deg) > tolerance_deg then return false end
    end
    return true
  end)
end

-- The tip within distance_m of where a named pose puts it.
function conditions.tip_near_pose(name, distance_m)
  return condition(("tip within %g m of pose %s"):format(distance_m, name), function(arm)
    local there = geometry.tip(arm.robot, arm.named_pose(name)).position
    return geometry.distance(arm.tip(), there) <= distance_m
  end)
end

-- The tip within distance_m of the press rod.
function conditions.tip_near_rod(distance_m)
  return condition(("tip within %g m of the rod"):format(distance_m), function(arm)
    return geometry.distance(arm.tip(), arm.scene.rod.position_m) <= distance_m
  end)
end

-- The tip at least u_m along the slit, from the base (the mouth is at slit.mouth_u_m).
function conditions.tip_past(u_m)
  return condition(("tip past u = %g m"):format(u_m), function(arm) return arm.slit_u() >= u_m end)
end

-- The tip at most distance_m off the middle plane of the slit.
function conditions.tip_in_plane(distance_m)
  return condition(("tip within %g m of the slit plane"):format(distance_m), function(arm)
    return math.abs(arm.slit_offset()) <= distance_m
  end)
end

-- The variables this step holds are held and at their targets.
function conditions.held()
  return condition("held variables at their targets", function(arm) return arm.holds_what_it_should() and arm.state.held_at_target end)
end

-- The operator engaged the device in this step and has let go of it.
function conditions.released()
  return condition("device released by the operator", function(arm) return arm.was_engaged and not arm.state.device_engaged end)
end

-- The operator said `what` after this step began.
function conditions.operator_says(what)
  return condition("operator says " .. what, function(arm)
    local said = arm.state.operator_says
    return said ~= nil and said.what == what and said.tick > arm.begin_tick
  end)
end

return conditions
