-- The arm as missions see it: the last state, the robot and scene, and every command of lua/liana/arm_stubs.lua.
local geometry = require "liana.geometry"
local retired = require "liana.retired_names"

local arm_state = {}

-- That of one session; `commands` are the bindings, `welcome` is lianad's first message (docs/reference/api.md).
function arm_state.new(commands, welcome)
  local arm = {
    robot = welcome.robot, scene = welcome.scene, period_s = welcome.period_s,
    state = nil, -- the last state message, docs/reference/api.md
    begin_tick = 0, -- tick at which the current step began
    was_engaged = false, -- the operator has engaged the device in this step
    goal = nil, -- of the last motion that the current step has asked for: { joints_deg } or { tip }
    must_hold = {}, -- what the current step holds: theta number -> degrees
  }

  -- Angles (deg) of a named pose; raises when the robot has none of that name.
  function arm.named_pose(name)
    return arm.robot.named_poses_deg[name] or error("the robot " .. arm.robot.name .. " has no pose named " .. tostring(name), 0)
  end

  -- The scene's "slit" or "rod"; raises when it has none.
  function arm.part_of_scene(name)
    return arm.scene[name] or error(("the scene %s has no %s"):format(arm.scene.name, name), 0)
  end

  -- Measured tip position {x, y, z} in the base frame [m].
  function arm.tip()
    local pose = arm.state.measured_cp
    return { pose[1], pose[2], pose[3] }
  end

  -- The same in the scene's drawing: the camera may see slit and rod stand beside it (state.clearance).
  function arm.tip_in_drawing()
    local seen = arm.state.clearance
    if not (seen and arm.scene.slit) then return arm.tip() end
    local pivot = arm.scene.slit.frame.position_m
    local from_pivot = geometry.add(geometry.add(arm.tip(), pivot, -1), seen.shift_m, -1)
    return geometry.add(pivot, geometry.turned(from_pivot, geometry.scale(seen.turn_deg, -1)))
  end

  -- How far the tip is along the slit, measured from the base [m].
  function arm.slit_u() return geometry.dot(arm.tip_in_drawing(), arm.part_of_scene("slit").u_axis) end

  -- Signed distance of the tip from the slit's middle plane [m].
  function arm.slit_offset() return geometry.dot(arm.tip_in_drawing(), arm.part_of_scene("slit").normal) - arm.scene.slit.offset_m end

  -- True when exactly the variables of this step are held.
  function arm.holds_what_it_should()
    local count = 0
    for _ in pairs(arm.must_hold) do count = count + 1 end
    for _, theta in ipairs(arm.state.held) do
      if arm.must_hold[theta] == nil then return false end
    end
    return count == #arm.state.held
  end

  -- Time of the arm since tick `since` [s].
  function arm.elapsed_s(since) return (arm.state.tick - since) * arm.period_s end

  retired.refuse_in(arm)
  return setmetatable(arm, { __index = commands })
end

return arm_state
