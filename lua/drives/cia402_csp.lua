-- Any drive with CiA 402's cyclic synchronous position. It is what drives are that no bus table names, and every value
-- is the one that a type has where its own table says nothing; for another drive write a table of another name
-- (docs/reference/drives.md).
return {
  format = 1, kind = "drive", name = "cia402_csp",
  source = "CiA 301 4.2.0, CiA 402-2 4.1",
  -- identity is the robot table's: vendor, product and revision of 0x1018.
  units = {
    position = 0x00B50000, -- 60A8: increments of the motor's encoder; written where the drive has the object
    speeds = "increments", -- 607F, 6085, 60C5 count increments; or "rpm", of the motor
    rated_torque = "mNm", -- 6076
    -- encoder (608F) is the robot's counts_per_turn to 1, gear (6091) the robot's gear, feed (6092) the counts of one
    -- turn behind the gear to 1.
  },
  polarity = 0, -- 607E, bits 7 and 6
  max_torque_permille = 1000, -- 6072
  following_time_ms = 100, -- 6066; the window (6065) follows from the robot
  stop = {
    within_s = 0.1, -- from the fastest command to rest: what 6085 and 60C5 must allow
    quick_stop_option = 2, -- 605A: ramp, then switch-on disabled
    fault_option = 2, -- 605E: quick-stop ramp
    abort_connection_option = 3, -- 6007: quick stop
  },
  mapping = "written", -- of RPDO1 and TPDO1; or "fixed": as the drive has it, if that is the right one
  times = { -- allowed to the drive
    sdo_answer_s = 1,
    boot_up_s = 10, -- from the first reset to the boot-up message
    operational_s = 2, -- from NMT start to the heartbeat that says so
  },
}
