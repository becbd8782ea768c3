-- The arm of the experiment with named poses along its way through the slit, to begin a scenario there: the true angles
-- of the mission slit_crossing, nominal, seed 7331, held ones at 0.
local robot = require "robots.zhu2022"

local poses = robot.named_poses_deg
poses.mouth = { -5.049, -12.194, 1.284, -0.046, 4.928, 12.851, 0.095, 8.686, 0, -6.116 } -- the tip at the mouth
poses.entering = { -4.529, -9.559, 1.558, -0.076, 3.851, 10.378, -0.009, 7.296, 0, -4.761 } -- step 4, the tip 0.6 m inside
poses.entered = { -4.201, -6.500, 1.505, -0.634, 3.215, 7.034, 0.006, 5.900, 0, -2.438 } -- the end of step 4
poses.inside = { -5.681, -7.030, 4.385, 3.039, 1.707, 3.894, 0, 4.318, 0, -0.887 } -- step 6, the tip 1.5 m inside

return robot
