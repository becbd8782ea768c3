-- The 7 torque drives of the arm that installs payloads, its wrist's force sensor and the adapter, on two classical 1 Mbit/s buses at 250 Hz,
-- for machines without CAN. Sensor and adapter are on the second bus, which has fewer drives.
return {
  format = 1, kind = "buses", name = "embedded_payload", backend = "embedded",
  rate_hz = 250, -- 500 Hz buys nothing: what is fast is damped in the drives
  command_interval_s = 0.02, -- T_c: five ticks
  buses = {
    { name = "can0", bitrate = 1000000, nodes = { 1, 2, 3, 4 } },
    { name = "can1", bitrate = 1000000, nodes = { 5, 6, 7 }, wrist_sensor = 32, adapter = 48 },
  },
  drives = {
    { type = "liana_cst", nodes = { 1, 2, 3, 4 } },
    { type = "liana_cst_wrist", nodes = { 5, 6, 7 } },
  },
  heartbeat_ms = 100, -- producer time of every drive and of the master (docs/reference/drives.md)
  max_load = 0.75, -- worst case with full bit stuffing; the loader refuses more
}
