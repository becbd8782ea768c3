-- A box with a hole of 100 mm in its front, and two corners inside, before the robot feeder. The way in is straight, then
-- around the first block to +y and around the second back to +x, by bends of 0.25 m. All figures are assumed.
local upright = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } }

local kWall_m = 0.02 -- thickness
local kHole_m = 0.1 -- of each side of the hole
local kFront_m, kBack_m = 0.49, 1.2 -- outside, along x
local kRight_m, kLeft_m = -0.2, 0.46 -- outside, along y
local kHalfHeight_m = 0.17 -- outside

local boxes = {}

-- A body that fills a room from its least to its largest coordinates.
local function fill(name, from, to)
  local center, half = {}, {}
  for i = 1, 3 do center[i], half[i] = (from[i] + to[i]) / 2, (to[i] - from[i]) / 2 end
  boxes[#boxes + 1] = { name = name, center_m = center, half_extent_m = half, rotation = upright }
end

local kInside_m = kFront_m + kWall_m
local hole = kHole_m / 2
fill("front_right", { kFront_m, kRight_m, -kHalfHeight_m }, { kInside_m, -hole, kHalfHeight_m })
fill("front_left", { kFront_m, hole, -kHalfHeight_m }, { kInside_m, kLeft_m, kHalfHeight_m })
fill("front_low", { kFront_m, -hole, -kHalfHeight_m }, { kInside_m, hole, -hole })
fill("front_high", { kFront_m, -hole, hole }, { kInside_m, hole, kHalfHeight_m })
fill("back", { kBack_m - kWall_m, kRight_m, -kHalfHeight_m }, { kBack_m, kLeft_m, kHalfHeight_m })
fill("right", { kInside_m, kRight_m, -kHalfHeight_m }, { kBack_m - kWall_m, kRight_m + kWall_m, kHalfHeight_m })
fill("left", { kInside_m, kLeft_m - kWall_m, -kHalfHeight_m }, { kBack_m - kWall_m, kLeft_m, kHalfHeight_m })
fill("floor", { kInside_m, kRight_m, -kHalfHeight_m }, { kBack_m - kWall_m, kLeft_m, -kHalfHeight_m + kWall_m })
fill("lid", { kInside_m, kRight_m, kHalfHeight_m - kWall_m }, { kBack_m - kWall_m, kLeft_m, kHalfHeight_m })

-- The corners: a block on the left that the way goes around first, and one on the right, into which it would go straight.
local kInner_m = kHalfHeight_m - kWall_m
fill("first_corner", { kInside_m, 0.0855, -kInner_m }, { 0.625, kLeft_m - kWall_m, kInner_m })
fill("second_corner", { 0.883, kRight_m + kWall_m, -kInner_m }, { kBack_m - kWall_m, 0.1905, kInner_m })

return {
  format = 1, kind = "scene", name = "feeder_box",
  boxes = boxes, spheres = {},
  camera = { rate_hz = 25, latency_s = 0.1, noise_m = 0.0003, noise_deg = 0.05, range_m = 3.0 },
  contact = { stiffness_N_per_m = 20000, damping_Ns_per_m = 50, friction = 0.2 },
}
