-- Nanotec CL4-E. Written from what is publicly known of its maker's dictionary. The document named below was not at
-- hand to compare it with, and it was not tried on hardware: begin with `liana drive check`, and correct the table.
return {
  format = 1, kind = "drive", name = "nanotec_cl4e",
  source = "Nanotec CL4-E Technical Manual CANopen, description of the object dictionary (not compared)",
  identity = { vendor = 0x26C }, -- product and revision: the robot table says them
  objects = {
    -- No deadline of an RPDO: a lost master is noticed by its heartbeat. No rated torque: permille of 6077 are of the
    -- rated current (0x203B); take the robot's rated_torque_Nm from the motor's data sheet, nobody checks it.
    absent = { "1400:5", "6076" },
    required = { "60A8" }, -- a new drive counts tenths of a degree; it is told to count increments
  },
  units = {
    velocity = 0x00B44700, -- 60A9: rpm
    speeds = "rpm",
    feed = { 1, 1 }, -- 6092 has no part in increments
  },
  dictionary = { -- of the bench's drive
    absent = { "1400:5", "6076" },
    added = {
      { object = "60A8", type = "u32", access = "rw", value = 0xFF410000 }, -- tenths of a degree
      { object = "60A9", type = "u32", access = "rw", value = 0x00B44700 },
      { object = "6092:1", type = "u32", access = "rw", value = 1 },
      { object = "6092:2", type = "u32", access = "rw", value = 1 },
      { object = "607D:1", type = "i32", access = "rw", value = 0 }, -- 0 and 0: no limits
      { object = "607D:2", type = "i32", access = "rw", value = 0 },
      { object = "607E", type = "u8", access = "rw", value = 0 },
      { object = "607F", type = "u32", access = "rw", value = 30000 }, -- assumed, rpm
      { object = "6080", type = "u32", access = "rw", value = 30000 }, -- assumed
      { object = "60C5", type = "u32", access = "rw", value = 5000 }, -- rpm/s
    },
  },
}
