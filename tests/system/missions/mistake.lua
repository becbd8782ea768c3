-- A script that fails while the arm moves.
local liana = require "liana"

local kWait_s = 6.0

return liana.mission "mistake" {
  liana.step "begin to move" {
    device = "none",
    run = liana.move_to "panel_edge",
    exit = liana.condition("some time has passed", function(arm) return arm.elapsed_s(arm.begin_tick) > kWait_s end),
    time_limit_s = 60,
    on_fail = "hold",
  },
  liana.step "mistake" {
    device = "none",
    run = function(arm)
      arm.move_jp { goal_deg = arm.named_pose "nowhere" }
    end,
    exit = liana.at_rest(),
    time_limit_s = 60,
    on_fail = "hold",
  },
  finish = liana.tool "none",
}
