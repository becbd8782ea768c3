-- Crossing the solar-panel slit like slit_crossing.lua, but no hand leads the tip into the slit and to the rod: the tip camera does, by
-- visual servo, and the rod is touched under a limit of force. `liana run slit_crossing_servo`.
local liana = require "liana"
local geometry = require "liana.geometry"
local step, all, any = liana.step, liana.all, liana.any
local at_rest, held, servo_done, servo_failed = liana.at_rest, liana.held, liana.servo_done, liana.servo_failed

-- Numbers to tune. Places are in the slit's frame: x into it from the mouth, y across, z along the mouth.
local kEdgeArrival_m = 0.15 -- how near the panel edge the tip has to be for step 2 to end
local kVrScale, kVrRotationScale = 4.0, 2.0 -- the recording is made for them
local kFreeSpeed_m_s, kSlitSpeed_m_s = 0.05, 0.025
local kBeforeMouth_m = { -0.40, 0, 0.50 } -- aligned here before going in
local kSwitch_m = { 1.37, 0, 0.36 } -- a little past where segment 4 has to go planar
local kBeforeRod_m = { -0.04, 0, 0 } -- in the rod's frame
local kTouch_N = 1.2 -- more than a tip that nothing touches ever shows
local kTouchSpeed_m_s = 0.005

-- What the tip camera of this arm allows: 25 Hz, 0.3 mm and 0.05 deg.
local function led(target, offset, fields)
  local all_fields = {
    target = target, offset = offset, tau_s = 1, gain_1_s = 0.4, accel_m_s2 = 0.02, accel_deg_s2 = 2, rate_deg_s = 3,
    lateral_speed_m_s = 0.02, lost_s = 2, timeout_s = 120, tolerance_m = 0.0025, tolerance_deg = 0.3,
  }
  for field, value in pairs(fields) do all_fields[field] = value end
  return function(arm) arm.servo_target(all_fields) end
end

-- A place in the slit, with the rod's attitude, which lies in the slit's plane.
local function in_slit(place_m, fields)
  return function(arm)
    local slit, rod = arm.part_of_scene("slit").frame, arm.part_of_scene "rod"
    local q = geometry.quaternion_between(slit.quaternion_wxyz, rod.quaternion_wxyz)
    led("slit", { place_m[1], place_m[2], place_m[3], q[1], q[2], q[3], q[4] }, fields)(arm)
  end
end

local function at_rod(place_m, fields) return led("rod", { place_m[1], place_m[2], place_m[3], 1, 0, 0, 0 }, fields) end

return liana.mission "slit_crossing_servo" {
  step "prepare pose" {
    device = "none",
    run = liana.move_to "prepare",
    exit = all { liana.at_pose "prepare", at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  step "around the obstacle to the panel edge" {
    device = "vr",
    task = "panel_edge_vr",
    teleoperate = { scale = kVrScale, rotation_scale = kVrRotationScale, node = 3, speed_m_s = 0.10 },
    enter = at_rest(),
    exit = all { liana.released(), liana.operator_says "arrived", liana.tip_near_pose("panel_edge", kEdgeArrival_m) },
    time_limit_s = 120,
    on_fail = "hold",
  },

  step "segment 5 goes planar" {
    device = "none",
    hold = { [9] = 0 },
    enter = at_rest(),
    exit = held(),
    time_limit_s = 30,
    on_fail = "hold",
  },

  step "aligned before the mouth" {
    device = "none",
    hold = { [9] = 0 },
    enter = all { held(), at_rest() },
    run = in_slit(kBeforeMouth_m, { speed_m_s = kFreeSpeed_m_s }),
    exit = all { servo_done(), at_rest() },
    fail_when = servo_failed(),
    time_limit_s = 125,
    on_fail = "retract",
    next = { { step = "aligned before the mouth", on = "failure", at_most = 1 } },
  },

  step "segment 5 into the slit" {
    device = "none",
    hold = { [9] = 0 },
    run = in_slit(kSwitch_m, { speed_m_s = kSlitSpeed_m_s, lateral_speed_m_s = 0.01 }),
    exit = all { servo_done(), liana.needs_planar(2), at_rest() },
    fail_when = servo_failed(),
    time_limit_s = 125,
    on_fail = "retract",
  },

  step "segments 4 and 5 go planar" {
    device = "none",
    hold = { [7] = 0, [9] = 0 },
    exit = held(),
    time_limit_s = 30,
    on_fail = "retract",
  },

  step "before the press rod" {
    device = "none",
    hold = { [7] = 0, [9] = 0 },
    enter = all { held(), at_rest() },
    run = at_rod(kBeforeRod_m, { speed_m_s = kSlitSpeed_m_s, lateral_speed_m_s = 0.01, tolerance_m = 0.002 }),
    exit = all { servo_done(), at_rest() },
    fail_when = any { servo_failed(), liana.tip_force(kTouch_N, 0.8) },
    time_limit_s = 125,
    on_fail = "retract",
  },

  -- The tip goes on until it is at the rod or the rod pushes: what comes first.
  step "touch the rod" {
    device = "none",
    hold = { [7] = 0, [9] = 0 },
    run = at_rod({ 0, 0, 0 }, { speed_m_s = kTouchSpeed_m_s, lateral_speed_m_s = 0.005, tolerance_m = 0.002 }),
    exit = any { servo_done(), liana.tip_force(kTouch_N, 0.8) },
    fail_when = servo_failed(),
    time_limit_s = 125,
    on_fail = "retract",
  },

  step "come to rest" {
    device = "none",
    run = function(arm) arm.hold() end,
    exit = at_rest(),
    time_limit_s = 10,
    on_fail = "retract",
  },

  finish = liana.tool "repair",
}
