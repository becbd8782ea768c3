-- The scene payload_adapter after the visual servo: the arm begins at `install` with the payload on it, its pins just before the adapter's face,
-- beside its axis by what a servo leaves.
local geometry = require "liana.geometry"
local robot = require "robots.macro_micro"
local scene = require "scenes.payload_adapter"

local tip = geometry.tip(robot, robot.named_poses_deg.install)
local payload = scene.payload
payload.start, payload.fetch_pose = "arm", nil
payload.position_m, payload.quaternion_wxyz = tip.position, geometry.quaternion(tip.rotation)
payload.start_lateral_m, payload.start_tilt_deg = 0.0014, 0.5 -- at most, in x and in y; drawn from the bench's seed

scene.name = "payload_at_adapter"
return scene
