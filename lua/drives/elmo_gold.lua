-- Elmo Gold line. Written from what is publicly known of its maker's dictionary. The document named below was not at
-- hand to compare it with, and it was not tried on hardware: begin with `liana drive check`, and correct the table.
return {
  format = 1, kind = "drive", name = "elmo_gold",
  source = "Elmo Motion Control, Gold Line: CANopen DS-301 and DS-402 implementation guides (not compared)",
  identity = { vendor = 0x9A }, -- product and revision: the robot table says them
  objects = {
    absent = { "1400:5" }, -- no deadline of an RPDO: a lost master is noticed by its heartbeat
    required = { "6076" }, -- rated torque: set it with the maker's tool, it scales every torque
  },
  dictionary = { -- of the bench's drive
    absent = { "1400:5" },
    added = {
      { object = "607D:1", type = "i32", access = "rw", value = 0 }, -- 0 and 0: no limits
      { object = "607D:2", type = "i32", access = "rw", value = 0 },
      { object = "607E", type = "u8", access = "rw", value = 0 },
      { object = "607F", type = "u32", access = "rw", value = 2000000000 }, -- assumed: increments/s
      { object = "6080", type = "u32", access = "rw", value = 30000 }, -- assumed
      { object = "60C5", type = "u32", access = "rw", value = 2000000000 }, -- assumed: increments/s^2
    },
  },
}
