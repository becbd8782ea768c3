-- The 7 drives of a small serial arm on two classical 1 Mbit/s buses at 250 Hz, for machines without CAN: room for a second report of
-- every drive, which torque control needs.
return {
  format = 1, kind = "buses", name = "embedded_micro", backend = "embedded",
  rate_hz = 250,
  command_interval_s = 0.02, -- T_c: five ticks
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4 } },
    { name = "can1", bitrate = 1000000, nodes = { 5, 6, 7 } },
  },
  heartbeat_ms = 100, -- producer time of every drive and of the master (docs/reference/drives.md)
  max_load = 0.75, -- worst case with full bit stuffing; the loader refuses more
}
