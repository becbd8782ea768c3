-- The arm of Zhu et al., Robot 44(1), 2022: 5 segments of 8 universal joints, 15 cables, 4 m.
-- "source" marks what the paper states; everything else is assumed, with the reason beside it.

local segment = {
  modules = 8, -- source: 8 equal-angle sub-joints per segment
  module_length_m = 0.1, -- source: 100 mm
  theta_limit_deg = 20, -- source: +-20 deg per sub-joint axis
}

-- Assumed: three cables 120 deg apart; each segment's set is turned by 24 deg so that all 15 holes of a disc are apart.
local phase_deg = {}
for m = 1, 5 do
  local turn = 24 * (m - 1)
  phase_deg[m] = { turn, 120 + turn, 240 + turn }
end

-- Assumed: neighbouring drums are mirrored, so that every second motor pays out with falling counts.
local direction, zero_counts = {}, {}
for i = 1, 15 do
  direction[i] = i % 2 == 1 and 1 or -1
  zero_counts[i] = 1000000 -- mid range of a multi-turn absolute encoder
end

return {
  format = 1, kind = "robot", name = "zhu2022",
  segments = { segment, segment, segment, segment, segment },
  module = {
    mass_kg = 0.3, -- source
    radius_m = 0.03, -- source: 60 mm diameter
  },
  joint = {
    viscous_Nms_per_rad = 0.4, -- assumed, per theta
  },
  cables = {
    hole_radius_m = 0.025, -- assumed: 5 mm inside the link's surface
    face_offset_m = 0.010, -- assumed: disc faces 10 mm before and after a joint centre
    phase_deg = phase_deg,
    EA_N = 240000, -- assumed: 2 mm steel rope
    lead_m = 0.5, -- assumed: free cable between drum and first disc
    friction_mu = { nominal = 0.05, ideal = 0, worn = 0.10 }, -- assumed: capstan coefficient per hole
    monitor = { -- twice what whole missions show (docs/explanation/fault-detection.md)
      jump_N = 7, -- change of tension within a tick that nothing explains
      contradiction_m = 0.0001, -- change of a segment's contradiction, without friction
    },
  },
  tension = { -- assumed: zero gravity, so tensions only fight slack and friction
    plan_N = 40,
    floor_motor_N = 15,
    floor_anywhere_N = 1, -- never slack
    ceiling_free_N = 150, -- in free motion
    alarm_N = 400,
    hard_limit_N = 600,
  },
  drives = {
    drum_radius_m = 0.015, -- assumed
    counts_per_turn = 65536, -- assumed: 16-bit encoder
    gear = 1, -- assumed: counts are taken at the drum
    servo_time_constant_s = 0.03, -- assumed: first-order position servo
    rated_torque_Nm = 9, -- assumed: the hard limit, 600 N, on the drum
    identity = { vendor = 0x4C49, product = 1, revision = 1 }, -- what object 0x1018 of every drive must say
    direction = direction,
    zero_counts = zero_counts,
  },
  limits = { -- assumed: slow, as in teleoperation
    theta_rate_deg_s = 2,
    theta_accel_deg_s2 = 4,
    tip_speed_m_s = 0.10,
    tip_speed_slit_m_s = 0.03,
    tip_accel_m_s2 = 0.22, -- what a lag of 0.25 s asks for: room to brake from full speed
    tip_jerk_m_s3 = 2.5,
    tip_rate_deg_s = 20,
    tip_angular_accel_deg_s2 = 44,
    tip_angular_jerk_deg_s3 = 500,
    tip_lag_s = 0.25, -- of the filter behind a steady hand
    cable_speed_m_s = 0.010,
  },
  named_poses_deg = { -- source, except zero; theta = pitch, yaw of segment 1, of segment 2, ...
    zero = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
    prepare = { -8.50, 0, -12.00, 0, 8.00, -2.00, 13.00, 0, 12.00, -2.00 },
    panel_edge = { -6.14, -15.00, -3.29, -8.72, 7.20, 15.0, 5.55, 15.0, 1.00, -2.80 },
    segment5_in_slit = { -2.79, -6.63, -1.75, -6.31, 5.03, 11.60, 1.87, 9.68, 0.00, -4.64 },
    jig = { 12, -9, 7, -8, 12, -3, 12, -10, -12, -2 }, -- assumed: every two cables differ by 13 mm, for calibration and --in-pose
    press_rod = { -2.641, -2.064, -1.81, -4.64, 4.777, 5.87, 0.00, 4.764, 0.00, -0.543 },
  },
}
