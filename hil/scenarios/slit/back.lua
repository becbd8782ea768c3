-- A way into the slit that is given up after six seconds and led back.
local liana = require "liana"

return liana.mission "back" {
  liana.step "segment 5 into the slit" {
    device = "hand",
    teleoperate = { scale = 4.0, rotation_scale = 1, speed_m_s = 0.10 },
    hold = { [9] = 0 },
    exit = liana.tip_past(3.9), -- never
    time_limit_s = 6,
    on_fail = "retract",
  },
}
