-- An arm for narrow places: three_segment_lab with 4 short and light segments, 0.8 m and 0.64 kg, lying at full gravity on a
-- base that feeds: a slide along x of 0.9 m of travel and a roll about it. 14 drives: slide, roll, then the 12 cables. All
-- figures are assumed: a rack for the slide, a belt for the roll, encoders of 14 bits.
local robot = require "robots.three_segment_lab"

local segment = { modules = 4, module_length_m = 0.05, theta_limit_deg = 18 }
robot.name = "feeder"
robot.base = {
  limit_deg = 90, -- of both: the slide stands within 0.45 m, the roll within a quarter turn
  slide_m_per_deg = 0.005,
  roll_radius_m = 0.05, -- of the belt's wheel
  mass_kg = 2,
}
robot.segments = { segment, segment, segment, segment }
robot.gravity_m_s2 = { 0, 0, -9.80665 }
robot.module = { mass_kg = 0.04, radius_m = 0.03 }
robot.cables.hole_radius_m = 0.026
for m = 1, 4 do
  local turn = 30 * (m - 1) -- all 12 holes of a disc are as far apart
  robot.cables.phase_deg[m] = { turn, 120 + turn, 240 + turn }
end
robot.tension.ceiling_free_N, robot.tension.alarm_N = 200, 300
robot.drives.counts_per_turn = 16384
for i = 10, 14 do robot.drives.direction[i], robot.drives.zero_counts[i] = 1, 500000 end -- in all: slide, roll, cables
local limits = robot.limits
limits.theta_rate_deg_s, limits.theta_accel_deg_s2 = 5, 10 -- of the slide 25 mm/s
limits.tip_speed_m_s = 0.03 -- about the slide's own
limits.cable_speed_m_s = 0.04
robot.named_poses_deg = { -- slide, roll, then pitch, yaw of segment 2 to 5
  zero = { 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
  back = { -85, 0, 0, 0, 0, 0, 0, 0, 0, 0 },
  look = { -20, 30, 6, -4, 5, 5, -6, 4, 3, 6 },
}
robot.start_pose = "back"
robot.jig_poses = nil
return robot
