-- The 7 drives of a small serial arm on one classical bus: the rate falls to 100 Hz, T_c becomes two ticks.
return {
  format = 1, kind = "buses", name = "embedded_micro_single", backend = "embedded",
  rate_hz = 100,
  command_interval_s = 0.02,
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4, 5, 6, 7 } },
  },
  heartbeat_ms = 100,
  max_load = 0.75,
}
