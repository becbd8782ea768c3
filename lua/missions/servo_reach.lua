-- The small arm is led by its tip camera to a place before a target: `liana run servo_reach`.
local liana = require "liana"
local step, all = liana.step, liana.all

-- Where the tip stands before the target, in the target's frame: x is the way in, and the tip's z points along it.
local kBefore = { -0.108, 0, 0, 0.5, 0.5, 0.5, 0.5 } -- source: 108 mm between the faces

return liana.mission "servo_reach" {
  robot = "micro",
  scene = "target_ahead",

  step "prepare pose" {
    device = "none",
    run = liana.move_to "prepare",
    exit = all { liana.at_pose "prepare", liana.at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  step "led by the camera" {
    device = "none",
    enter = liana.at_rest(),
    run = liana.servo_target { target = "rod", offset = kBefore },
    exit = liana.servo_done(),
    fail_when = liana.servo_failed(),
    time_limit_s = 130,
    on_fail = "hold",
    next = { { step = "prepare pose", on = "failure", at_most = 2 } }, -- not seen, or not there in time: from the beginning
  },
}
