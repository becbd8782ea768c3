-- The 14 drives of feeder on two classical 1 Mbit/s buses: slide (node 1), roll (node 2), cables.
return {
  format = 1, kind = "buses", name = "embedded_feeder", backend = "embedded",
  rate_hz = 250,
  command_interval_s = 0.02,
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4, 5, 6, 7 } },
    { name = "can1", bitrate = 1000000, nodes = { 8, 9, 10, 11, 12, 13, 14 } },
  },
  heartbeat_ms = 100,
  max_load = 0.75,
}
