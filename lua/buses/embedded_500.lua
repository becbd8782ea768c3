-- 15 drives at 500 Hz, for machines without CAN: four buses, because one carries up to five drives at that rate within 75 % worst-case load.
return {
  format = 1, kind = "buses", name = "embedded_500", backend = "embedded",
  rate_hz = 500,
  command_interval_s = 0.02,
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4 } },
    { name = "can1", bitrate = 1000000, nodes = { 5, 6, 7, 8 } },
    { name = "can2", bitrate = 1000000, nodes = { 9, 10, 11, 12 } },
    { name = "can3", bitrate = 1000000, nodes = { 13, 14, 15 } },
  },
  heartbeat_ms = 100,
  max_load = 0.75,
}
