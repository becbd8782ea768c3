-- The operator steers with the VR handles until something happens to somebody.
local liana = require "liana"

local kOutOfReach_m = 3.9 -- along the slit: the recording never goes there

return liana.mission "steered" {
  liana.step "around the obstacle" {
    device = "vr",
    teleoperate = { scale = 4, rotation_scale = 2, node = 3, speed_m_s = 0.10 },
    exit = liana.tip_past(kOutOfReach_m),
    time_limit_s = 12,
    on_fail = "hold",
  },
}
