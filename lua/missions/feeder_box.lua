-- The robot feeder goes into a box through a hole of 100 mm, around two corners inside, and back out the same way.
local liana = require "liana"
local step, all = liana.step, liana.all
local move_to, at_pose, at_rest = liana.move_to, liana.at_pose, liana.at_rest
local follow_curve, follow_back, curve_followed = liana.follow_curve, liana.follow_back, liana.curve_followed

-- Numbers to tune.
local kRadius_m = 0.25 -- of the bends, which the box is made for (scenes/feeder_box.lua)
local kTurn_deg = 60
local kPoint_m = 0.01 -- between the points

-- A curve at z = 0, drawn from a place along +x.
local function drawn_from(x_m)
  local curve = { points = { { x_m, 0, 0 } }, heading_deg = 0 }

  -- `length_m` on, the heading turning evenly by `turn_deg` to the left.
  function curve.on(length_m, turn_deg)
    local count = math.ceil(length_m / kPoint_m)
    local piece_m, turn = length_m / count, turn_deg / count
    for _ = 1, count do
      local last, heading = curve.points[#curve.points], math.rad(curve.heading_deg + turn / 2)
      curve.points[#curve.points + 1] = { last[1] + piece_m * math.cos(heading), last[2] + piece_m * math.sin(heading), 0 }
      curve.heading_deg = curve.heading_deg + turn
    end
  end

  return curve
end

local curve = drawn_from(0.375) -- the tip of the pose `back`, before the box
curve.on(0.155, 0)
curve.on(kRadius_m * math.rad(kTurn_deg), kTurn_deg)
curve.on(0.03, 0)
curve.on(kRadius_m * math.rad(kTurn_deg), -kTurn_deg)
curve.on(0.06, 0)

local way = { points = curve.points }

return liana.mission "feeder_box" {
  robot = "feeder", bus = "embedded_feeder", scene = "feeder_box",

  step "before the hole" {
    device = "none",
    run = move_to "back",
    exit = all { at_pose "back", at_rest() },
    time_limit_s = 120,
    on_fail = "hold",
  },

  step "in and around two corners" {
    device = "none",
    enter = at_rest(),
    run = follow_curve(way),
    exit = curve_followed(),
    time_limit_s = 600,
    on_fail = "retract",
  },

  step "back out" {
    device = "none",
    enter = at_rest(),
    run = follow_back(way),
    exit = curve_followed(),
    time_limit_s = 600,
    on_fail = "hold",
  },
}
