-- A small mission of the small arm: from where it stands to the prepare pose, along straight lines to a place beside it and back, and to the
-- pose from which it installs.
local liana = require "liana"
local step, all, condition = liana.step, liana.all, liana.condition
local move_to = liana.move_to
local at_pose, at_rest, tip_near_pose = liana.at_pose, liana.at_rest, liana.tip_near_pose
local geometry = require "liana.geometry"

-- Numbers to tune.
local kAside_m = { 0.20, -0.15, 0.25 } -- from the prepare pose, in the base frame
local kArrival_m = 0.002 -- by the arm's own measurement

-- Tip of the prepare pose, moved by `factor` times kAside_m: position and quaternion {x, y, z, w, qx, qy, qz}.
local function beside_prepare(arm, factor)
  local tip = geometry.tip(arm.robot, arm.named_pose "prepare")
  local p, q = geometry.add(tip.position, kAside_m, factor), geometry.quaternion(tip.rotation)
  return { p[1], p[2], p[3], q[1], q[2], q[3], q[4] }
end

local function line_to(factor)
  return function(arm) arm.move_cp { goal = beside_prepare(arm, factor) } end
end

local arrived = condition("tip beside the prepare pose", function(arm)
  return geometry.distance(arm.tip(), beside_prepare(arm, 1)) <= kArrival_m
end)

return liana.mission "micro_reach" {
  robot = "micro",

  step "prepare pose" {
    device = "none",
    run = move_to "prepare",
    exit = all { at_pose "prepare", at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  step "straight to the side" {
    device = "none",
    enter = at_rest(),
    run = line_to(1),
    exit = all { arrived, at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  step "straight back" {
    device = "none",
    enter = at_rest(),
    run = line_to(0),
    exit = all { tip_near_pose("prepare", kArrival_m), at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  step "where it installs" {
    device = "none",
    enter = at_rest(),
    run = move_to "install",
    exit = all { at_pose "install", at_rest() },
    time_limit_s = 400, -- half a turn and more of most joints, at 3 deg/s of the tip
    on_fail = "stop",
  },
}
