-- Something that the tip camera of micro sees from its pose `prepare`: a target (drawn as a rod) half a metre before where the tip
-- should stand, beside the way and turned. For its visual servo (missions/servo_reach.lua).
local geometry = require "liana.geometry"
local robot = require "robots.micro"

local kStandoff_m = 0.108 -- source: gap of the faces in which the payload was captured
local kAhead_m = 0.5 -- source: of the 608 mm that the servo starts with
local kAside_m = { 0.015, 0.020 } -- source: y and z; its 30 mm along x is in the way ahead
local kTurn_deg = { 0.5, -0.4, 0.6 } -- assumed: of the target against the tip

local tip = geometry.tip(robot, robot.named_poses_deg.prepare)
local ahead, y, z = geometry.axis(tip.rotation, 3), geometry.axis(tip.rotation, 1), geometry.axis(tip.rotation, 2)

local position = geometry.add(tip.position, ahead, kAhead_m + 0.03 + kStandoff_m)
position = geometry.add(geometry.add(position, y, kAside_m[1]), z, kAside_m[2])

-- The target's x is the way in, which is the tip's z.
local axes = {}
for i, axis in ipairs { ahead, y, z } do axes[i] = geometry.turned(axis, kTurn_deg) end
local columns = {}
for row = 1, 3 do columns[row] = { axes[1][row], axes[2][row], axes[3][row] } end

return {
  format = 1, kind = "scene", name = "target_ahead",
  boxes = {}, spheres = {},
  rod = { position_m = position, quaternion_wxyz = geometry.quaternion(columns), radius_m = 0.01, stiffness_N_per_m = 20 },
  camera = { rate_hz = 10, latency_s = 0.2, noise_m = 0.002, noise_deg = 0.2, range_m = 3.0 }, -- source: 2 mm and 0.2 deg; rest assumed
  contact = { stiffness_N_per_m = 20000, damping_Ns_per_m = 50, friction = 0.2 },
}
