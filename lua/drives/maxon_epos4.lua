-- maxon EPOS4. Compared, object by object, with its maker's data sheet named below; what that does not say is marked
-- "assumed". Not tried on hardware.
return {
  format = 1, kind = "drive", name = "maxon_epos4",
  source = "maxon motor ag, EPOS4 Module 50/5, electronic data sheet, file version 2, revision 0x0170, 05-04-2021",
  identity = { vendor = 0xFB }, -- product and revision differ by size and firmware: the robot table says them
  objects = {
    -- No deadline of an RPDO: a lost master is noticed by its heartbeat. The encoder is in 0x3010 and the gear in
    -- 0x3003: nobody checks the robot's counts_per_turn and gear. Torque is limited by the output current, 0x3001.
    absent = { "1400:5", "608F:1", "608F:2", "6072", "6091:1", "6091:2" },
    fixed = {
      ["6066"] = 0, -- its only value: a following error counts at once
      ["60C2:2"] = 0xFD, -- as at power-on, 10^-3 s; assumed that it takes no other
    },
  },
  units = {
    velocity = 0x00B44700, -- 60A9 at power-on: rpm
    speeds = "rpm",
    rated_torque = "uNm", -- assumed; 6076 is 0 until the maker's tool has set it, and is refused until then
  },
  dictionary = { -- of the bench's drive
    absent = { "1400:5", "608F", "6072", "6091" },
    read_only = { "6066", "60C2:2" },
    values = { ["6066"] = 0, ["60C2:2"] = -3, ["6065"] = 2000 },
    added = {
      { object = "60A8", type = "u32", access = "rw", value = 0x00B50000 },
      { object = "60A9", type = "u32", access = "rw", value = 0x00B44700 },
      { object = "607D:1", type = "i32", access = "rw", value = 0 }, -- 0 and 0: no limits
      { object = "607D:2", type = "i32", access = "rw", value = 0 },
      { object = "607F", type = "u32", access = "rw", value = 50000 }, -- rpm
      { object = "6080", type = "u32", access = "rw", value = 50000 },
      { object = "60C5", type = "u32", access = "rw", value = 4294967295 },
    },
  },
}
