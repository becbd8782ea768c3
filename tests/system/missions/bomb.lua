-- A script that takes all memory while the arm moves.
local liana = require "liana"

local kWait_s = 6.0

return liana.mission "bomb" {
  liana.step "begin to move" {
    device = "none",
    run = liana.move_to "panel_edge",
    exit = liana.condition("some time has passed", function(arm) return arm.elapsed_s(arm.begin_tick) > kWait_s end),
    time_limit_s = 60,
    on_fail = "hold",
  },
  liana.step "bomb" {
    device = "none",
    run = function()
      local t = {} for i = 1, 1e9 do t[i] = { i, i, i, i } end
    end,
    exit = liana.at_rest(),
    time_limit_s = 60,
    on_fail = "hold",
  },
  finish = liana.tool "none",
}
