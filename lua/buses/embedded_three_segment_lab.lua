-- The 9 drives of three_segment_lab on one classical 1 Mbit/s bus: 200 Hz is what it carries; T_c is four ticks.
return {
  format = 1, kind = "buses", name = "embedded_three_segment_lab", backend = "embedded",
  rate_hz = 200,
  command_interval_s = 0.02,
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4, 5, 6, 7, 8, 9 } },
  },
  heartbeat_ms = 100,
  max_load = 0.75,
}
