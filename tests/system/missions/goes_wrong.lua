-- A script that goes wrong while the arm moves; runs_test.py says how.
local liana = require "liana"

local kWait_s = 6.0

local function go_wrong(arm) -- luacheck: ignore 212 (some ways need no arm)
  -- WHAT GOES WRONG
end

return liana.mission "goes_wrong" {
  liana.step "begin to move" {
    device = "none",
    run = liana.move_to "panel_edge",
    exit = liana.condition("some time has passed", function(arm) return arm.elapsed_s(arm.begin_tick) > kWait_s end),
    time_limit_s = 60,
    on_fail = "hold",
  },
  liana.step "go wrong" {
    device = "none",
    run = go_wrong,
    exit = liana.at_rest(),
    time_limit_s = 60,
    on_fail = "hold",
  },
}
