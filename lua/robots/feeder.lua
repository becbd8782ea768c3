-- An arm for narrow places: 4 segments of 4 universal joints, 0.8 m and 0.64 kg, lying at full gravity on a base that
-- feeds: a slide along x of 0.9 m of travel and a roll about it. 14 drives: slide, roll, then the 12 cables. All figures
-- are assumed: bearings and rope of a hobby shop, small servo drives, a rack for the slide, a belt for the roll.

local segment = { modules = 4, module_length_m = 0.05, theta_limit_deg = 18 }

-- Three cables a segment, 120 deg apart; each segment's set is turned by 30 deg so that all 12 holes of a disc are apart.
local phase_deg, direction, zero_counts = {}, {}, {}
for m = 1, 4 do
  local turn = 30 * (m - 1)
  phase_deg[m] = { turn, 120 + turn, 240 + turn }
end
for i = 1, 14 do
  direction[i] = 1
  zero_counts[i] = 500000
end

return {
  format = 1, kind = "robot", name = "feeder",
  base = {
    limit_deg = 90, -- of both: the slide stands within 0.45 m, the roll within a quarter turn
    slide_m_per_deg = 0.005,
    roll_radius_m = 0.05, -- of the belt's wheel
    mass_kg = 2,
  },
  segments = { segment, segment, segment, segment },
  gravity_m_s2 = { 0, 0, -9.80665 },
  module = { mass_kg = 0.04, radius_m = 0.03 },
  joint = { viscous_Nms_per_rad = 0.3 },
  cables = {
    hole_radius_m = 0.026,
    face_offset_m = 0.008,
    phase_deg = phase_deg,
    EA_N = 150000, -- 1.5 mm steel rope
    lead_m = 0.3,
    friction_mu = { nominal = 0.05, ideal = 0, worn = 0.10 },
  },
  tension = { plan_N = 30, floor_motor_N = 10, floor_anywhere_N = 1, ceiling_free_N = 200, alarm_N = 300, hard_limit_N = 400 },
  drives = {
    drum_radius_m = 0.012,
    counts_per_turn = 16384,
    gear = 1,
    servo_time_constant_s = 0.03,
    rated_torque_Nm = 5,
    identity = { vendor = 0x4C49, product = 1, revision = 1 },
    direction = direction, -- slide, roll, cables
    zero_counts = zero_counts,
  },
  limits = {
    theta_rate_deg_s = 5, -- of the slide 25 mm/s
    theta_accel_deg_s2 = 10,
    tip_speed_m_s = 0.03, -- the slide's own
    tip_speed_slit_m_s = 0.03,
    tip_accel_m_s2 = 0.15,
    tip_jerk_m_s3 = 1,
    tip_rate_deg_s = 20,
    tip_angular_accel_deg_s2 = 40,
    tip_angular_jerk_deg_s3 = 400,
    cable_speed_m_s = 0.04,
  },
  named_poses_deg = { -- slide, roll, then pitch, yaw of segment 2 to 5
    zero = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
    back = { -85, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
    look = { -20, 30, 6, -4, 5, 5, -6, 4, 3, 6 },
  },
  start_pose = "back",
}
