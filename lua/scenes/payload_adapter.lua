-- What the small arm of macro_micro installs: a payload on the transfer mechanism, and the adapter that it goes into
-- (docs/explanation/payload.md). Everything is in the frame of the small arm's base as it is when nothing pushes: the
-- payload with the large arm at `fetch`, the adapter with it at `install`. "source" marks what the paper states; the
-- rest is assumed.
local geometry = require "liana.geometry"
local robot = require "robots.macro_micro"

local kLength_m = 1.0 -- of the payload, from its grapple to the tips of its pins
local kMass_kg = 500
local kBefore_m = 0.005 -- the pins' tips before the adapter's face with the arm at `install`: within the funnels, where force takes over
local kPickTurn_deg = 40 -- from `install` about the small arm's first joint: there the mechanism hands it over; on the other side booms meet

local function at(pose, z_m)
  return { position_m = geometry.add(pose.position, geometry.axis(pose.rotation, 3), z_m),
           quaternion_wxyz = geometry.quaternion(pose.rotation) }
end

local install_deg = robot.named_poses_deg.install
local pick_deg = { table.unpack(install_deg) }
pick_deg[1] = pick_deg[1] + kPickTurn_deg
local install, pick = geometry.tip(robot, install_deg), geometry.tip(robot, pick_deg)

local payload = at(pick, 0) -- of its grapple, z towards the pins
payload.start, payload.fetch_pose = "mechanism", "fetch" -- the large arm brings it to the site from there
payload.mass_kg, payload.length_m = kMass_kg, kLength_m
payload.radius_m = 0.3 -- its pins stand on a circle of 0.25 m
payload.center_m = { 0, 0, 0.5 * kLength_m }
payload.inertia_kgm2 = { kMass_kg / 6, kMass_kg / 6, kMass_kg / 6, 0, 0, 0 } -- xx, yy, zz, xy, xz, yz about the centre

return {
  format = 1, kind = "scene", name = "payload_adapter",
  boxes = {}, spheres = {},
  payload = payload,
  adapter = at(install, kLength_m + kBefore_m), -- the middle of the socket's face, z into it
  camera = { -- noise: source, 2 mm and 0.2 deg
    rate_hz = 10, latency_s = 0.2, noise_m = 0.002, noise_deg = 0.2, range_m = 4.0,
    bias_m = 0.0003, bias_deg = 0.1, dropout = 0.05,
  },
  contact = { stiffness_N_per_m = 20000, damping_Ns_per_m = 200, friction = 0.15 }, -- as the adapter's pins
}
