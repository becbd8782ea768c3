-- The operator steers, never gets there in time, and would go on steering: the arm has to go back, and to stay back.
local liana = require "liana"

local kOutOfReach_m = 3.9 -- along the slit: the recording never goes there

return liana.mission "back_out" {
  liana.step "around the obstacle" {
    device = "vr",
    teleoperate = { scale = 4, rotation_scale = 2, node = 3, speed_m_s = 0.10 },
    enter = liana.at_rest(),
    exit = liana.tip_past(kOutOfReach_m),
    time_limit_s = 6,
    on_fail = "retract",
  },
}
