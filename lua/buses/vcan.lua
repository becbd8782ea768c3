-- SocketCAN on two virtual CAN interfaces; with real adapters, change the interface names.
return {
  format = 1, kind = "buses", name = "vcan", backend = "socketcan",
  rate_hz = 250,
  command_interval_s = 0.02,
  buses = {
    { name = "vcan0", bitrate = 1000000, nodes = { 1, 2, 3, 4, 5, 6, 7, 8 } },
    { name = "vcan1", bitrate = 1000000, nodes = { 9, 10, 11, 12, 13, 14, 15 } },
  },
  heartbeat_ms = 100,
  max_load = 0.75,
}
