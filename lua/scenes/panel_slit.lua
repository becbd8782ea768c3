-- A folded solar panel in front of a satellite wall, with the press rod behind it (the experiment of the source).
-- The source gives no coordinates: all numbers are assumed unless "source" stands beside them.
local geometry = require "liana.geometry"
local robot = require "robots.zhu2022"

local kHalfGap = 0.05 -- source: slit <= 100 mm
local kMouth = 1.75 -- m along u, where the slit begins
local kEnd = 3.70
local kHalfWidth = 2.0 -- m along w
local kHalfThickness = 0.01 -- 20 mm plates

-- The published press-rod angles put segments 4 and 5 in one plane; that plane is the middle of the slit.
local rod = geometry.tip(robot, robot.named_poses_deg.press_rod)
local normal = geometry.unit(geometry.axis(rod.rotation, 2))
local offset = geometry.dot(normal, rod.position)

-- u is base x projected on the plane, w completes the right-handed axes u, n, w.
local u = geometry.unit(geometry.add({ 1, 0, 0 }, normal, -normal[1]))
local w = geometry.cross(u, normal)
local columns = { { u[1], normal[1], w[1] }, { u[2], normal[2], w[2] }, { u[3], normal[3], w[3] } }

local function in_plane(along_u, off_plane)
  return geometry.add(geometry.scale(u, along_u), normal, offset + off_plane)
end

-- A plate with its inner face half a gap off the plane; side 1 is +n, -1 is -n.
local function plate(name, side)
  return {
    name = name,
    center_m = in_plane((kMouth + kEnd) / 2, side * (kHalfGap + kHalfThickness)),
    half_extent_m = { (kEnd - kMouth) / 2, kHalfThickness, kHalfWidth },
    rotation = { u, normal, w },
  }
end

return {
  format = 1, kind = "scene", name = "panel_slit",
  boxes = {
    plate("panel", 1), plate("wall", -1),
    { -- source: motors and drums; as far behind the root as cables run free to their drums (cables.lead_m)
      name = "drive_box", center_m = { -0.7, 0, 0 }, half_extent_m = { 0.2, 0.08, 0.08 },
      rotation = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } },
    },
  },
  spheres = {
    { name = "obstacle", center_m = { -0.15, 0.28, 1.10 }, radius_m = 0.25 }, -- in the way of a tip-only motion to the panel edge
  },
  slit = {
    normal = normal, offset_m = offset, u_axis = u, w_axis = w,
    mouth_u_m = kMouth, end_u_m = kEnd, half_gap_m = kHalfGap,
    frame = { position_m = in_plane(kMouth, 0), quaternion_wxyz = geometry.quaternion(columns) },
  },
  rod = {
    position_m = rod.position, quaternion_wxyz = geometry.quaternion(rod.rotation),
    radius_m = 0.010,
    stiffness_N_per_m = 50, -- gives way softly: the tip is meant to touch it
  },
  camera = { rate_hz = 25, latency_s = 0.1, noise_m = 0.0003, noise_deg = 0.05, range_m = 3.0 },
  -- found: true plates never more than 6.7 mm nearer than predicted (docs/explanation/verification.md), and stops of an
  -- arm with worn cables up to 3 mm nearer than that
  margins = { prediction_m = 0.007, slow_m = 0.006, refuse_m = 0.003 },
  contact = { stiffness_N_per_m = 20000, damping_Ns_per_m = 50, friction = 0.2 }, -- stiff plates, bare metal on foil
}
