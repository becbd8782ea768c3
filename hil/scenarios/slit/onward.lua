-- The crossing from somewhere in the slit on: steps 4 to 6 of lua/missions/slit_crossing.lua. One that has been done where
-- the arm begins ends at once.
local liana = require "liana"
local step, all = liana.step, liana.all
local held, released, operator_says = liana.held, liana.released, liana.operator_says

return liana.mission "onward" {
  step "segment 5 into the slit" {
    device = "hand",
    teleoperate = { scale = 4.0, rotation_scale = 1, speed_m_s = 0.10 },
    hold = { [9] = 0 },
    exit = liana.needs_planar(2),
    time_limit_s = 200,
    on_fail = "retract",
  },

  step "segments 4 and 5 go planar" {
    device = "none",
    hold = { [7] = 0, [9] = 0 },
    exit = held(),
    time_limit_s = 30,
    on_fail = "retract",
  },

  step "to the press rod" {
    device = "hand",
    teleoperate = { scale = 2.0, rotation_scale = 1, speed_m_s = 0.03 },
    hold = { [7] = 0, [9] = 0 },
    enter = held(),
    exit = all { released(), operator_says "arrived", liana.tip_near_rod(0.02) },
    time_limit_s = 60,
    on_fail = "retract",
  },

}
