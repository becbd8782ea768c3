-- The tip touches a press rod under a stated force, and feels it better after a dither: `liana run rod_touch`.
local liana = require "liana"
local step, all = liana.step, liana.all
local move_to, at_pose, at_rest, tip_force = liana.move_to, liana.at_pose, liana.at_rest, liana.tip_force

-- Numbers to tune.
local kTouch_N = 0.6
local kSlow_deg_s = 0.2
local kDither = 0.1 -- little: the push has loosened some cables, and 15 N at the motor are least
local kSure_N = 0.25 -- deviation along every axis, after the dither

return liana.mission "rod_touch" {
  scene = "rod_ahead",

  step "prepare pose" {
    device = "none",
    run = move_to "prepare",
    exit = all { at_pose "prepare", at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  step "until the rod pushes" {
    device = "none",
    run = move_to("panel_edge", kSlow_deg_s),
    exit = tip_force(kTouch_N),
    time_limit_s = 60,
    on_fail = "retract",
  },

  step "come to rest" {
    device = "none",
    run = function(arm) arm.hold() end,
    exit = at_rest(),
    time_limit_s = 10,
    on_fail = "retract",
  },

  step "feel it better" {
    device = "none",
    run = function(arm) arm.dither { share = kDither, duration_s = 4 } end,
    exit = all { at_rest(), tip_force(0.5 * kTouch_N, kSure_N) },
    time_limit_s = 20,
    on_fail = "retract",
  },
}
