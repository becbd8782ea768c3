-- ZeroErr eRob: motor, gear and drive in one joint. Compared, object by object, with its maker's data sheet named
-- below; what that does not say is marked "assumed". Not tried on hardware.
return {
  format = 1, kind = "drive", name = "zeroerr_erob",
  source = "ZEROERR CONTROL, eDriver (CANopen), electronic data sheet, file version 5, revision 4, 09-05-2022",
  identity = { vendor = 0x5A65726F }, -- product and revision: the robot table says them
  objects = {
    -- Encoder and gear are inside: nobody checks the robot's counts_per_turn, which is that of the output (assumed),
    -- and its gear is 1. No torque limit, and what it does at a quick stop or a lost connection is the maker's: try it
    -- before the arm hangs on it. 607F, 6085 and 60C5 are there, the latter two at most 65500 and 200 at power-on, in a
    -- unit that the data sheet does not name, but not increments: they are not asked for. Set them with the maker's
    -- tool, so that the motor rests within 0.1 s.
    absent = { "608F:1", "608F:2", "6007", "605A", "6066", "6072", "607F", "6085", "60C5" },
  },
  dictionary = { -- of the bench's drive
    absent = { "608F", "6091", "6007", "605A", "6066", "6072" },
    values = { ["6502"] = 909 },
    added = {
      { object = "607D:1", type = "i32", access = "rw", value = -2147483648 },
      { object = "607D:2", type = "i32", access = "rw", value = 2147483647 },
      { object = "607F", type = "u32", access = "rw", value = 100 },
      { object = "6080", type = "u32", access = "rw", value = 3000 }, -- assumed
      { object = "60C5", type = "u32", access = "rw", value = 200 },
    },
  },
}
