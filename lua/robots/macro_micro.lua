-- The pair in series (requirement B1): the small arm on the tip of the large one, whose joints are locked. What moves is the small arm; the
-- large one is its base, and gives way where it is pushed.
local micro, macro = require "robots.micro", require "robots.macro"

micro.name = "macro_micro"
micro.base = {
  robot = macro,
  pose = "install", -- where the large arm is locked
  damping_s = 0.02, -- assumed: of the locked joints, 0.02 s of their stiffness
  carry_s = 240, -- assumed: what its own controller takes from `fetch` to `install`; quicker leaves it swinging
}
micro.start_pose = "install"

-- The small arm's drives follow torques and damp by themselves (docs/explanation/force-control.md): the large arm is
-- too soft for damping over the bus.
micro.drives.mode = "torque"
-- assumed: joint rate for a joint that is off its target; more swings with 500 kg (docs/explanation/force-control.md)
micro.drives.position_gain_per_s = 0.01
micro.force_control = { -- assumed, as tuned in a prototype of this arm on its base
  max_force_N = 60, -- on the tip; the source sets 30 N
  max_joint_Nm = 100, -- source: joint torques stay below 150 N m
  max_travel_m = 0.2, -- along the axis, from where a push begins
  max_lateral_m = 0.03, -- across it: the adapter's tolerance (source: 30 mm)
  max_turn_deg = 3,
  wrist_still_samples = 25, -- with the very same six numbers: a sensor that lives has noise; 0 for one that may rest on a number
  gains = { -- what a push has, the least and the most that one may ask for
    mass_kg = { 500, 50, 5000 }, -- M_d
    inertia_kgm2 = { 100, 10, 1000 },
    axial_damping_Ns_per_m = { 2400, 800, 8000 }, -- K_D
    lateral_damping_Ns_per_m = { 3000, 800, 8000 },
    turn_damping_Nms_per_rad = { 1500, 200, 5000 },
    force_gain = { 1, 0.5, 2 }, -- K_P C_F
    stiffness_N_per_m = { 3000, 100, 10000 }, -- K_P, impedance only
    turn_stiffness_Nm_per_rad = { 900, 10, 5000 },
    approach_m_s = { 0.0035, 0.0005, 0.01 },
    unload_damping_Ns_per_m = { 300, 100, 8000 }, -- K_D along the axis from capture on
  },
}
return micro
