-- The two-segment tendon-driven continuum robot on which models are compared in: P. Rao, Q. Peyron, S. Lilge, J. Burgner-Kahrs, "How to model
-- tendon-driven continuum robots and benchmark modelling performance", Frontiers in Robotics and AI 7, 2021, doi 10.3389/frobt.2020.630245.
-- "source" marks what its published code says (github.com/SvenLilge/tdcr-modeling): the robot that its C++ makes by default, with the masses
-- of matlab/Parameters/tdcr_2segments.m. Everything else is assumed. The backbone between two discs is one universal joint with a spring,
-- half-way between them, and a disc is a module's middle. So the base frame is 5 mm from where the backbone is clamped, and the tip 5 mm
-- beyond the last disc. Four angles reach places, not poses: missions turn joints.

local spacing_m = 0.01 -- source: 10 discs a segment of 100 mm
local thick_m = 0.001 -- source: a backbone of 0.5 mm radius
local stiffness_Nm2 = 60e9 * math.pi / 64 * thick_m ^ 4 -- source: 60 GPa
local backbone_kg_m = 0.0115 * (thick_m / 0.0014) ^ 2 -- source: 0.0115 kg/m of 1.4 mm

local segment = {
  modules = 10, -- source
  module_length_m = spacing_m,
  theta_limit_deg = 9, -- assumed: 90 deg a segment
}

return {
  format = 1, kind = "robot", name = "tdcr_benchmark",
  segments = { segment, segment },
  gravity_m_s2 = { 0, 0, -9.80665 }, -- assumed: it lies
  module = { mass_kg = 0.0002 + backbone_kg_m * spacing_m, radius_m = 0.01 }, -- source: discs of 0.2 g; assumed: 20 mm wide
  joint = {
    viscous_Nms_per_rad = 0.002, -- assumed
    stiffness_Nm_per_rad = stiffness_Nm2 / spacing_m,
  },
  cables = {
    hole_radius_m = { 0.008, 0.006 }, -- source
    face_offset_m = spacing_m / 6, -- cables shorten as those between thin discs on an arc
    phase_deg = { { 90, 210, 330 }, { 90, 210, 330 } }, -- source: the first straight up
    EA_N = 4000, -- assumed: 0.3 mm nitinol wire
    lead_m = 0.2, -- assumed
    friction_mu = { nominal = 0.02, ideal = 0, worn = 0.04 }, -- assumed: wire in printed holes
    monitor = { jump_N = 1, contradiction_m = 0.0005 }, -- assumed: thin wire stretches
  },
  tension = { plan_N = 3, floor_motor_N = 1, floor_anywhere_N = 0.1, ceiling_free_N = 25, alarm_N = 32, hard_limit_N = 40 }, -- assumed
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
    jig_a = { -7, 5, -4, -3 },
    jig_b = { -6, -7, 1, -7 },
  },
  start_pose = "hook",
  jig_poses = { "zero", "jig_a", "jig_b" },
}
