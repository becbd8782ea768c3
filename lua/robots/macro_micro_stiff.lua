-- macro_micro on a large arm that is 20 times as stiff, as a real one may well be (docs/explanation/payload.md): what
-- the soft one keeps the payload's mission from shows beside it.
local robot = require "robots.macro_micro"

for _, joint in ipairs(robot.base.robot.joints) do joint.stiffness_Nm_per_rad = 20 * joint.stiffness_Nm_per_rad end -- assumed
robot.base.carry_s = 60 -- its swings are four times as quick
robot.name = "macro_micro_stiff"
return robot
