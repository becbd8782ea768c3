-- Default: 15 drives on two classical 1 Mbit/s buses at 250 Hz, for machines without CAN.
-- Two buses because one carries 15 drives only up to about 190 Hz at 75 % worst-case load.
return {
  format = 1, kind = "buses", name = "embedded", backend = "embedded",
  rate_hz = 250,
  command_interval_s = 0.02, -- T_c: five ticks; the arbiter's pace (design: setpoints averaged over 20 ms)
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4, 5, 6, 7, 8 } },
    { name = "can1", bitrate = 1000000, nodes = { 9, 10, 11, 12, 13, 14, 15 } },
  },
  heartbeat_ms = 100, -- producer time of every drive and of the master (docs/reference/drives.md)
  max_load = 0.75, -- worst case with full bit stuffing; the loader refuses more
}
