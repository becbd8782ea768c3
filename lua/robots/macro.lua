-- The large arm of the macro-micro pair that installs payloads (Liu et al.; requirement B1): 7 revolute joints, 10 m, loads to 25 t.
-- "source" marks what the paper states; everything else is assumed, with the reason beside it.

-- Assumed: rows as those of the small arm (micro.lua), longer. The lengths give the source's working radius of 10 m (9.91 m).
local function joint(alpha_deg, a_m, d_m)
  return {
    alpha_deg = alpha_deg, a_m = a_m, d_m = d_m,
    low_deg = -270, high_deg = 270, -- assumed: cables inside the joint, one and a half turns
    rate_deg_s = 2, accel_deg_s2 = 2, -- assumed: half of the small arm's, the tip as fast
    stiffness_Nm_per_rad = 4264, -- assumed: gives the source's largest deflection of 20 mm under 1 N; a real arm may well be 20 times as stiff
  }
end

-- Assumed: every second gear is mounted the other way round.
local direction, zero_counts = {}, {}
for i = 1, 7 do
  direction[i] = i % 2 == 1 and 1 or -1
  zero_counts[i] = 1000000
end

return {
  format = 1, kind = "serial", name = "macro",
  joints = { -- source: 7 joints
    joint(90, 0, 0.50), -- roll
    joint(90, 0, 0.40), -- yaw
    joint(0, 4.30, 0.35), -- pitch, first boom
    joint(0, 4.30, 0), -- pitch, second boom
    joint(90, 0, 0.35), -- pitch
    joint(-90, 0, 0.40), -- yaw
    joint(0, 0, 0.50), -- roll, to the tip of the end effector
  },
  link_radius_m = 0.22, -- assumed: as the joint modules; nothing of a link is farther from the line along it
  mass = { -- assumed, 640 kg in all: the source states only the largest load (25 t)
    module_kg = 60, -- of each joint module, as a sphere
    module_radius_m = 0.22,
    boom_kg = 60, -- of each link with a length along x, as a rod
    end_effector_kg = 100, -- at the tip
  },
  friction = { -- assumed, at the joint: as the small arm's, by torque
    coulomb_Nm = 20,
    viscous_Nms_per_rad = 100,
    rotor_inertia_kgm2 = 60, -- reflected
  },
  drives = {
    counts_per_turn = 1048576, -- assumed: 20-bit absolute encoder
    gear = 1, -- assumed: counts are taken at the joint
    servo_time_constant_s = 0.03, -- assumed: first-order position servo
    rated_torque_Nm = 1000, -- assumed, at the joint
    peak_torque_Nm = 2000, -- assumed: twice the rated torque for a while
    identity = { vendor = 0x4C49, product = 2, revision = 1 }, -- what object 0x1018 of every drive must say
    direction = direction,
    zero_counts = zero_counts,
  },
  limits = { -- assumed: slow, as near a station; the joints' rates hold besides
    tip_speed_m_s = 0.10,
    tip_accel_m_s2 = 0.10,
    tip_jerk_m_s3 = 0.4,
    tip_rate_deg_s = 1.5,
    tip_angular_accel_deg_s2 = 1.5,
    tip_angular_jerk_deg_s3 = 6,
  },
  named_poses_deg = { -- assumed
    zero = { 0, 0, 0, 0, 0, 0, 0 }, -- stretched: no pose to work from
    prepare = { 13, -175, 126, -61, 16, 15, 136 }, -- 7.8 m out; the tip's own motion passes the configuration that is stiffest along its axis
    install = { 12.4, -176, 126.9, -61.7, 20, 14.8, 132.2 }, -- locked there while the small arm inserts the payload
    fetch = { -17.6, -180, 131, -66, 26, 10, 128 }, -- where the small arm fetches the payload
  },
  start_pose = "prepare",
}
