-- Around three_segment_lab: a floor under it, a wall at its side, a ball in its way. All figures are assumed.
local upright = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }

return {
  format = 1, kind = "scene", name = "lab_box",
  boxes = {
    { name = "floor", center_m = { 0.7, 0, -0.55 }, half_extent_m = { 0.6, 0.5, 0.02 }, rotation = upright },
    { name = "wall", center_m = { 0.9, 0.90, 0.0 }, half_extent_m = { 0.3, 0.02, 0.3 }, rotation = upright },
  },
  spheres = { { name = "ball", center_m = { 0.9, 0.15, 0.30 }, radius_m = 0.12 } },
  camera = { rate_hz = 25, latency_s = 0.1, noise_m = 0.0003, noise_deg = 0.05, range_m = 3.0 },
  contact = { stiffness_N_per_m = 20000, damping_Ns_per_m = 50, friction = 0.2 },
}
