-- Crossing the solar-panel slit to the press rod: the experiment of Zhu et al. (2022), six steps, then the repair command.
-- theta_7 and theta_9 are the pitch angles X4 and X5 of segments 4 and 5; held at 0 they keep those segments in the slit's plane.
local liana = require "liana"
local step, all = liana.step, liana.all
local move_to, tool = liana.move_to, liana.tool
local at_pose, at_rest, held = liana.at_pose, liana.at_rest, liana.held
local released, operator_says = liana.released, liana.operator_says
local tip_near_pose, tip_near_rod, needs_planar = liana.tip_near_pose, liana.tip_near_rod, liana.needs_planar

-- Numbers to tune.
local kEdgeArrival_m = 0.15 -- how near the panel edge the tip has to be for step 2 to end
local kRodArrival_m = 0.02 -- how near the rod, by the arm's own measurement, the tip has to be for step 6 to end
local kVrScale = 4.0 -- metres of tip per metre of right hand, node 3 and left hand alike; the recording is made for it
local kVrRotationScale = 2.0
local kEntryScale = 4.0 -- hand controller on the 3 m way in: its workspace is a ball of 70 mm
local kRodScale = 2.0 -- hand controller near the rod: finer
local kFreeSpeed_m_s = 0.10
local kSlitSpeed_m_s = 0.03

return liana.mission "slit_crossing" {
  step "prepare pose" {
    device = "none",
    run = move_to "prepare",
    exit = all { at_pose "prepare", at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  step "around the obstacle to the panel edge" {
    device = "vr", -- right hand: tip; left hand: node 3, and with it the arm's shape
    teleoperate = { scale = kVrScale, rotation_scale = kVrRotationScale, node = 3, speed_m_s = kFreeSpeed_m_s },
    enter = at_rest(),
    exit = all { released(), operator_says "arrived", tip_near_pose("panel_edge", kEdgeArrival_m) },
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

  step "segment 5 into the slit" {
    device = "hand",
    teleoperate = { scale = kEntryScale, rotation_scale = 1, speed_m_s = kFreeSpeed_m_s },
    hold = { [9] = 0 },
    enter = held(),
    exit = needs_planar(2),
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
    teleoperate = { scale = kRodScale, rotation_scale = 1, speed_m_s = kSlitSpeed_m_s },
    hold = { [7] = 0, [9] = 0 },
    enter = held(),
    exit = all { released(), operator_says "arrived", tip_near_rod(kRodArrival_m) },
    time_limit_s = 90,
    on_fail = "retract",
  },

  finish = tool "repair",
}
