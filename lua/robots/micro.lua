-- The small arm of the macro-micro pair that installs payloads (Liu et al.; requirement B1): 7 revolute joints, 5 m.
-- "source" marks what the paper states; everything else is assumed, with the reason beside it.

-- Assumed: roll-yaw-pitch-pitch-pitch-yaw-roll with the offsets of arms of this class (Canadarm2, ERA); standard DH rows: turn about z by the
-- joint angle, d along z, a along the new x, turn by alpha about the new x. The lengths give the source's working radius of 5 m (4.93 m).
local function joint(alpha_deg, a_m, d_m)
  return {
    alpha_deg = alpha_deg, a_m = a_m, d_m = d_m,
    low_deg = -270, high_deg = 270, -- assumed: cables inside the joint, one and a half turns
    rate_deg_s = 4, accel_deg_s2 = 4, -- assumed: as arms of this class, unloaded; at rest within a second
    stiffness_Nm_per_rad = 8e4, -- assumed: of the gear
  }
end

-- Assumed: every second gear is mounted the other way round.
local direction, zero_counts = {}, {}
for i = 1, 7 do
  direction[i] = i % 2 == 1 and 1 or -1
  zero_counts[i] = 1000000
end

return {
  format = 1, kind = "serial", name = "micro",
  joints = { -- source: 7 joints
    joint(90, 0, 0.28), -- roll
    joint(90, 0, 0.22), -- yaw
    joint(0, 2.10, 0.20), -- pitch, first boom
    joint(0, 2.10, 0), -- pitch, second boom
    joint(90, 0, 0.20), -- pitch
    joint(-90, 0, 0.22), -- yaw
    joint(0, 0, 0.28), -- roll, to the tip of the end effector
  },
  link_radius_m = 0.15, -- assumed: as the joint modules; nothing of a link is farther from the line along it
  mass = { -- assumed, 300 kg in all: the source states only the largest load (3 t)
    module_kg = 30, -- of each joint module, as a sphere
    module_radius_m = 0.15,
    boom_kg = 25, -- of each link with a length along x, as a rod
    end_effector_kg = 40, -- at the tip
  },
  friction = { -- assumed, at the joint
    coulomb_Nm = 8,
    viscous_Nms_per_rad = 40,
    rotor_inertia_kgm2 = 10, -- reflected: gear 160, rotor 3.9e-4 kg m2
    gear_damping_Nms_per_rad = 60, -- across the gear's spring
  },
  drives = {
    counts_per_turn = 1048576, -- assumed: 20-bit absolute encoder
    gear = 1, -- assumed: counts are taken at the joint
    servo_time_constant_s = 0.03, -- assumed: first-order position servo
    rated_torque_Nm = 150, -- at the joint; source: joint torques stay below 150 N m
    peak_torque_Nm = 300, -- assumed: twice the rated torque for a while
    identity = { vendor = 0x4C49, product = 2, revision = 1 }, -- what object 0x1018 of every drive must say
    direction = direction,
    zero_counts = zero_counts,
  },
  limits = { -- assumed: slow, as near a station; the joints' rates hold besides
    tip_speed_m_s = 0.10,
    tip_accel_m_s2 = 0.10,
    tip_jerk_m_s3 = 0.4,
    tip_rate_deg_s = 3,
    tip_angular_accel_deg_s2 = 3,
    tip_angular_jerk_deg_s3 = 12,
  },
  named_poses_deg = { -- assumed
    zero = { 0, 0, 0, 0, 0, 0, 0 }, -- stretched: no pose to work from
    prepare = { 0, 60, -30, 100, -40, 60, 0 },
    install = { -77, -117, -97, 139, 125, 107, 46 }, -- where the base is stiff enough for force control
  },
}
