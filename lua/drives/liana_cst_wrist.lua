-- The liana_cst of a wrist joint, which moves less mass: half the damping.
local drive = require "drives.liana_cst"
drive.name = "liana_cst_wrist"
drive.writes[1].value = 1500
return drive
