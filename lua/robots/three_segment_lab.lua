-- An arm as a lab builds it first: 3 segments of 6 universal joints, 9 cables, 1.44 m, 9 drives on one bus (buses/embedded_three_segment_lab.lua).
-- All figures are assumed: those of hobby bearings, 1.5 mm rope and small servo drives. Copy it for an arm of your own
-- (docs/how-to/bring-your-own-arm.md).

local segment = { modules = 6, module_length_m = 0.08, theta_limit_deg = 15 }

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
  format = 1, kind = "robot", name = "three_segment_lab",
  segments = { segment, segment, segment },
  module = { mass_kg = 0.2, radius_m = 0.025 },
  joint = { viscous_Nms_per_rad = 0.3 },
  cables = {
    hole_radius_m = 0.02,
    face_offset_m = 0.008,
    phase_deg = phase_deg,
    EA_N = 150000, -- 1.5 mm steel rope
    lead_m = 0.3,
    friction_mu = { nominal = 0.05, ideal = 0, worn = 0.10 },
  },
  tension = { plan_N = 30, floor_motor_N = 10, floor_anywhere_N = 1, ceiling_free_N = 120, alarm_N = 250, hard_limit_N = 400 },
  drives = {
    drum_radius_m = 0.012,
    counts_per_turn = 4096,
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
