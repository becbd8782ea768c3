-- A lab's arm at full gravity, lying: three_segment_lab with 5 shorter and lighter modules a segment, 0.9 m and 0.9 kg
-- in all, 0.1 kg at its tip, and encoders of 14 bits. A segment has 5 cables: without any one of them the others still
-- surround it, and carry the arm however it is mounted; 3 or 4 cannot. All figures are assumed. For another mounting
-- turn gravity_m_s2, which is in the base frame: x is along the straight arm, so {9.80665, 0, 0} hangs.
local robot = require "robots.three_segment_lab"

local segment = { modules = 5, module_length_m = 0.06, theta_limit_deg = 15 }
robot.name = "lab_1g"
robot.segments = { segment, segment, segment }
robot.gravity_m_s2 = { 0, 0, -9.80665 }
robot.tool = { mass_kg = 0.1, center_m = { 0.02, 0, 0 } }
robot.module = { mass_kg = 0.06, radius_m = 0.035 }
robot.cables.hole_radius_m = 0.03
for m = 1, 3 do
  local turn = 24 * (m - 1) -- all 15 holes of a disc are as far apart
  for i = 1, 5 do robot.cables.phase_deg[m][i] = turn + 72 * (i - 1) end
end
robot.tension.ceiling_free_N, robot.tension.alarm_N, robot.tension.hard_limit_N = 200, 300, 400
robot.drives.counts_per_turn = 16384
for i = 10, 15 do robot.drives.direction[i], robot.drives.zero_counts[i] = 1, 500000 end
return robot
