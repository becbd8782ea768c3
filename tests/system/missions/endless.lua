-- A script that stops answering while the arm moves.
local liana = require "liana"

local kWait_s = 6.0

return liana.mission "endless" {
  liana.step "begin to move" {
    device = "none",
    run = liana.move_to "panel_edge",
    exit = liana.condition("some time has passed", function(arm) return arm.elapsed_s(arm.begin_tick) > kWait_s end),
    time_limit_s = 60,
    on_fail = "hold",
  },
  liana.step "endless" {
    device = "none",
    run = function()
      while true do pcall(function() while true do end end) end
    end,
    exit = liana.at_rest(),
    time_limit_s = 60,
    on_fail = "hold",
  },
  finish = liana.tool "none",
}
