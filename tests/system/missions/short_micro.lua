-- The small arm in seconds instead of minutes: to the prepare pose, a little aside along a straight line, then one
-- joint a little on.
local liana = require "liana"
local geometry = require "liana.geometry"

local kAside_m = { 0.04, -0.03, 0.05 } -- in the base frame
local kArrival_m = 0.002
local kJoint, kTurn_deg = 4, 3.0

-- Tip of the prepare pose, moved by kAside_m: position and quaternion {x, y, z, w, qx, qy, qz}.
local function beside_prepare(arm)
  local tip = geometry.tip(arm.robot, arm.named_pose "prepare")
  local p, q = geometry.add(tip.position, kAside_m, 1), geometry.quaternion(tip.rotation)
  return { p[1], p[2], p[3], q[1], q[2], q[3], q[4] }
end

local function goal_deg(arm)
  local goal = {}
  for i, angle_deg in ipairs(arm.named_pose "prepare") do goal[i] = angle_deg end
  goal[kJoint] = goal[kJoint] + kTurn_deg
  return goal
end

local beside = liana.condition("tip beside the prepare pose", function(arm)
  return geometry.distance(arm.tip(), beside_prepare(arm)) <= kArrival_m
end)
local turned = liana.condition("the joint at its goal", function(arm)
  return math.abs(arm.state.setpoint_js_deg[kJoint] - goal_deg(arm)[kJoint]) < 0.01
end)

return liana.mission "short_micro" {
  liana.step "prepare" {
    device = "none",
    run = liana.move_to "prepare",
    exit = liana.all { liana.at_pose "prepare", liana.at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },
  liana.step "a little aside" {
    device = "none",
    run = function(arm) arm.move_cp { goal = beside_prepare(arm) } end,
    exit = liana.all { beside, liana.at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },
  liana.step "one joint a little on" {
    device = "none",
    run = function(arm) arm.move_jp { goal_deg = goal_deg(arm) } end,
    exit = liana.all { turned, liana.at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },
}
