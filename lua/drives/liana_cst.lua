-- A torque drive with damping of its own, as force control needs it (docs/reference/drives.md): cyclic synchronous
-- torque, and at 1 kHz the loop around its joint torque sensor. Reading 60B1, the velocity offset, as the rate that the
-- damping is against is this drive's own definition: CiA 402 does not use it with torque.
return {
  format = 1, kind = "drive", name = "liana_cst",
  source = "CiA 301 4.2.0, CiA 402-2 4.1; 60B1 and 3001 as docs/reference/drives.md says, of the bench's drive",
  mode = "cst",
  writes = {
    { object = "3001:1", name = "damping", bits = 32, value = 3000, read_back = true }, -- N m s/rad
    { object = "3001:2", name = "drift integral", bits = 32, value = 2000, read_back = true }, -- 0.001/s
    { object = "3001:3", name = "torque gain", bits = 32, value = 3000, read_back = true }, -- 0.001
    { object = "3001:4", name = "torque integral", bits = 32, value = 10000, read_back = true }, -- 0.001/s
    { object = "3001:5", name = "torque derivative", bits = 32, value = 0, read_back = true }, -- us
  },
}
