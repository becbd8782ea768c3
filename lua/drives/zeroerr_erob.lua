-- ZeroErr eRob: motor, gear and drive in one joint. Read in its maker's public dictionary, object by object; not tried
-- on hardware.
return {
  format = 1, kind = "drive", name = "zeroerr_erob",
  source = "ZeroErr eRob CANopen and EtherCAT User Manual, object dictionary (edition not checked)",
  identity = { vendor = 0x5A65726F }, -- product and revision: the robot table says them
  objects = {
    -- No deadline of an RPDO (assumed): a lost master is noticed by its heartbeat. Encoder and gear are inside: nobody
    -- checks the robot's counts_per_turn, which is that of the output, and its gear is 1. No torque limit, and what it
    -- does at a quick stop or a lost connection is the maker's: try it before the arm hangs on it.
    absent = { "1400:5", "608F:1", "608F:2", "6007", "605A", "6066", "6072" },
  },
  dictionary = { -- of the bench's drive
    absent = { "1400:5", "608F", "6007", "605A", "6066", "6072" },
    added = {
      { object = "607D:1", type = "i32", access = "rw", value = 0 }, -- assumed: 0 and 0: no limits
      { object = "607D:2", type = "i32", access = "rw", value = 0 },
      { object = "607F", type = "u32", access = "rw", value = 2000000000 }, -- assumed: increments/s
      { object = "60C5", type = "u32", access = "rw", value = 2000000000 }, -- assumed: increments/s^2
    },
  },
}
