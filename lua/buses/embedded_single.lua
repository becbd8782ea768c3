-- All 15 drives on one classical bus: the rate falls to 100 Hz, T_c becomes two ticks.
return {
  format = 1, kind = "buses", name = "embedded_single", backend = "embedded",
  rate_hz = 100,
  command_interval_s = 0.02,
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15 } },
  },
  heartbeat_ms = 100,
  max_load = 0.75,
}
