-- The two-segment tendon-driven continuum robot on which models are compared in: P. Rao, Q. Peyron, S. Lilge, J. Burgner-Kahrs, "How to model
-- tendon-driven continuum robots and benchmark modelling performance", Frontiers in Robotics and AI 7, 2021, doi 10.3389/frobt.2020.630245.
-- "source" marks what its published parameters say; everything else is assumed. A disc and the backbone between two discs are one
-- universal joint here, so the arm bends in equal steps, which is the paper's constant-curvature model; gravity and the backbone's stiffness
-- are left out. Four angles reach places, not poses: missions turn joints.

local segment = {
  modules = 10, -- source: 10 discs a segment
  module_length_m = 0.01, -- source: 100 mm a segment
  theta_limit_deg = 9, -- assumed: 90 deg a segment
}

return {
  format = 1, kind = "robot", name = "tdcr_benchmark",
  segments = { segment, segment },
  module = { mass_kg = 0.004, radius_m = 0.01 }, -- assumed: printed discs of 20 mm
  joint = { viscous_Nms_per_rad = 0.002 }, -- assumed
  cables = {
    hole_radius_m = 0.008, -- source: of segment 1; that of segment 2, 6 mm in the source, is the same here
    face_offset_m = 0.002, -- assumed: discs of 4 mm
    phase_deg = { { 90, 210, 330 }, { 30, 150, 270 } }, -- source: 120 deg apart, the first straight up; assumed: segment 2 turned
    EA_N = 4000, -- assumed: 0.3 mm nitinol wire
    lead_m = 0.2, -- assumed
    friction_mu = { nominal = 0.02, ideal = 0, worn = 0.04 }, -- assumed: wire in printed holes
    monitor = { jump_N = 1, contradiction_m = 0.0005 }, -- assumed: thin wire stretches
  },
  tension = { plan_N = 3, floor_motor_N = 1, floor_anywhere_N = 0.1, ceiling_free_N = 15, alarm_N = 25, hard_limit_N = 40 }, -- assumed
  drives = { -- assumed: small servo drives with a drum of 10 mm radius
    drum_radius_m = 0.01,
    counts_per_turn = 16384,
    gear = 1,
    servo_time_constant_s = 0.03,
    rated_torque_Nm = 0.4,
    identity = { vendor = 0x4C49, product = 1, revision = 1 },
    direction = { 1, 1, 1, 1, 1, 1 },
    zero_counts = { 500000, 500000, 500000, 500000, 500000, 500000 },
  },
  limits = { -- assumed
    theta_rate_deg_s = 2,
    theta_accel_deg_s2 = 4,
    tip_speed_m_s = 0.05,
    tip_speed_slit_m_s = 0.02,
    tip_accel_m_s2 = 0.1,
    tip_jerk_m_s3 = 1,
    tip_rate_deg_s = 30,
    tip_angular_accel_deg_s2 = 60,
    tip_angular_jerk_deg_s3 = 600,
    cable_speed_m_s = 0.010,
  },
  named_poses_deg = {
    zero = { 0, 0, 0, 0 },
    hook = { 3, -2, -4, 3 },
    left = { 2, 5, -1, 4 },
    right = { 1, -5, 2, -3 },
    jig_a = { -7, 5, -6, -4 },
    jig_b = { -8, -7, -7, -8 },
  },
  start_pose = "hook",
  jig_poses = { "zero", "jig_a", "jig_b" },
}
