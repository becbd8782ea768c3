-- Nothing around the arm: no bodies, no slit, no rod.
return {
  format = 1, kind = "scene", name = "none",
  boxes = {}, spheres = {},
  camera = { rate_hz = 25, latency_s = 0.1, noise_m = 0.0003, noise_deg = 0.05, range_m = 3.0 },
  contact = { stiffness_N_per_m = 20000, damping_Ns_per_m = 50, friction = 0.2 },
}
