-- maxon EPOS4. Read in its maker's public dictionary, object by object; not tried on hardware.
return {
  format = 1, kind = "drive", name = "maxon_epos4",
  source = "maxon EPOS4 Firmware Specification, chapter 6, object dictionary (edition not checked)",
  identity = { vendor = 0xFB }, -- product and revision differ by size and firmware: the robot table says them
  objects = {
    -- No deadline of an RPDO: a lost master is noticed by its heartbeat. The encoder is in 0x3010 and the gear in 0x3003:
    -- nobody checks the robot's counts_per_turn. Torque is limited by the output current, 0x3001.
    absent = { "1400:5", "608F:1", "608F:2", "6072" },
    fixed = {
      ["6066"] = 0, -- a following error counts at once
      ["60C2:2"] = 0xFD, -- assumed fixed: 10^-3 s
    },
  },
  units = {
    velocity = 0x00B44700, -- 60A9: rpm
    speeds = "rpm",
    rated_torque = "uNm",
  },
  dictionary = { -- of the bench's drive
    absent = { "1400:5", "608F", "6072" },
    read_only = { "6066", "60C2:2" },
    values = { ["6066"] = 0, ["60C2:2"] = -3, ["6065"] = 2000 },
    added = {
      { object = "60A8", type = "u32", access = "rw", value = 0x00B50000 },
      { object = "60A9", type = "u32", access = "rw", value = 0x00B44700 },
      { object = "607D:1", type = "i32", access = "rw", value = -2147483648 },
      { object = "607D:2", type = "i32", access = "rw", value = 2147483647 },
      { object = "607F", type = "u32", access = "rw", value = 50000 }, -- rpm
      { object = "6080", type = "u32", access = "rw", value = 50000 },
      { object = "60C5", type = "u32", access = "rw", value = 4294967295 },
    },
  },
}
