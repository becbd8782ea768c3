-- A lab's arm at full gravity, lying: 3 segments of 5 universal joints, 9 cables, 0.9 m, 0.9 kg and 0.1 kg at its tip.
-- All figures are assumed: printed discs, hobby bearings, 1.5 mm rope and servo drives. For another mounting copy the table
-- and turn gravity_m_s2, which is in the base frame: x is along the straight arm, so {9.80665, 0, 0} hangs.

local segment = { modules = 5, module_length_m = 0.06, theta_limit_deg = 15 }

-- Three cables 120 deg apart; each segment's set is turned by 40 deg so that all 9 holes of a disc are apart.
local phase_deg, direction, zero_counts = {}, {}, {}
for m = 1, 3 do
  local turn = 40 * (m - 1)
  phase_deg[m] = { turn, 120 + turn, 240 + turn }
end
for i = 1, 9 do
  direction[i] = 1
  zero_counts[i] = 500000
end

return {
  format = 1, kind = "robot", name = "lab_1g",
  segments = { segment, segment, segment },
  gravity_m_s2 = { 0, 0, -9.80665 },
  tool = { mass_kg = 0.1, center_m = { 0.02, 0, 0 } },
  module = { mass_kg = 0.06, radius_m = 0.035 },
  joint = { viscous_Nms_per_rad = 0.3 },
  cables = {
    hole_radius_m = 0.03,
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
    direction = direction,
    zero_counts = zero_counts,
  },
  limits = {
    theta_rate_deg_s = 3,
    theta_accel_deg_s2 = 6,
    tip_speed_m_s = 0.10,
    tip_speed_slit_m_s = 0.03,
    tip_accel_m_s2 = 0.15,
    tip_jerk_m_s3 = 1,
    tip_rate_deg_s = 20,
    tip_angular_accel_deg_s2 = 40,
    tip_angular_jerk_deg_s3 = 400,
    cable_speed_m_s = 0.010,
  },
  named_poses_deg = { -- pitch, yaw of segment 1, 2, 3
    zero = { 0, 0, 0, 0, 0, 0 },
    park = { 5, -4, 3, 6, -4, 2 },
    look = { -6, 3, 5, -5, 8, 4 },
    deep = { -3, 8, -8, 6, 2, -7 },
    jig_a = { 12, -10, 11, 9, -12, 13 },
    jig_b = { -9, 12, 13, -8, 11, -13 },
  },
  start_pose = "park",
  jig_poses = { "zero", "jig_a", "jig_b" },
}
