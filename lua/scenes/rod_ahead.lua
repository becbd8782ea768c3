-- A soft press rod on the way from `prepare` to `panel_edge` of zhu2022, and nothing else: for touching it (missions/rod_touch.lua).
local geometry = require "liana.geometry"
local robot = require "robots.zhu2022"

local kShare = 0.12 -- of the way, where the rod's middle is
local kRadius_m = 0.08

local function tip_at(share)
  local from, to, angles_deg = robot.named_poses_deg.prepare, robot.named_poses_deg.panel_edge, {}
  for i = 1, #from do angles_deg[i] = from[i] + share * (to[i] - from[i]) end
  return geometry.tip(robot, angles_deg).position
end

local middle = tip_at(kShare)
local along = geometry.unit(geometry.add(tip_at(kShare + 0.01), middle, -1))

-- x along the way of the tip: the rod gives way along it.
local across = geometry.unit(geometry.cross({ 0, 0, 1 }, along))
local up = geometry.cross(along, across)
local columns = { { along[1], across[1], up[1] }, { along[2], across[2], up[2] }, { along[3], across[3], up[3] } }

return {
  format = 1, kind = "scene", name = "rod_ahead",
  boxes = {}, spheres = {},
  rod = {
    position_m = middle, quaternion_wxyz = geometry.quaternion(columns),
    radius_m = kRadius_m,
    stiffness_N_per_m = 20,
  },
  camera = { rate_hz = 25, latency_s = 0.1, noise_m = 0.0003, noise_deg = 0.05, range_m = 3.0 },
  contact = { stiffness_N_per_m = 20000, damping_Ns_per_m = 50, friction = 0.2 },
}
