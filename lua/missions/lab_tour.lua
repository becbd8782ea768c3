-- The first mission of three_segment_lab: to two poses, with the tip straight up and back, and home. `liana run lab_tour`.
local liana = require "liana"
local step, all, condition = liana.step, liana.all, liana.condition
local move_to, at_pose, at_rest = liana.move_to, liana.at_pose, liana.at_rest
local geometry = require "liana.geometry"

-- Numbers to tune.
local kUp_m = 0.03
local kArrival_m = 0.002 -- by the arm's own measurement
local kTolerance_deg = 0.5

-- The tip of the pose `look`, `up_m` higher: position and quaternion {x, y, z, w, qx, qy, qz}.
local function over_look(arm, up_m)
  local tip = geometry.tip(arm.robot, arm.named_pose "look")
  local p, q = tip.position, geometry.quaternion(tip.rotation)
  return { p[1], p[2], p[3] + up_m, q[1], q[2], q[3], q[4] }
end

local function tip_at(up_m)
  return condition("tip " .. 1000 * up_m .. " mm over the pose", function(arm)
    return geometry.distance(arm.tip(), over_look(arm, up_m)) <= kArrival_m
  end)
end

local function pose_step(name)
  return step("pose " .. name) {
    device = "none",
    run = move_to(name),
    exit = all { at_pose(name, kTolerance_deg), at_rest() },
    time_limit_s = 60,
    on_fail = "retract",
  }
end

local function tip_step(name, up_m)
  return step(name) {
    device = "none",
    enter = at_rest(),
    run = function(arm) arm.move_cp { goal = over_look(arm, up_m) } end,
    exit = all { tip_at(up_m), at_rest() },
    time_limit_s = 30,
    on_fail = "retract",
  }
end

return liana.mission "lab_tour" {
  robot = "three_segment_lab",
  scene = "lab_box",

  pose_step "park",
  pose_step "look",
  tip_step("tip up", kUp_m),
  tip_step("tip down", 0),
  pose_step "zero",
}
