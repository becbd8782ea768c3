-- An arm stands in 14 poses, for liana calibrate --tracker: `liana run tracker_tour --robot lab_1g --scene none --record tour`.
-- A pose that lianad refuses is left out. Leave room for all poses of the arm. A base that feeds stays where it is.
local liana = require "liana"

-- Numbers to tune.
local kPoses = 14
local kShare = 0.7 -- of the angle limits
local kStay_s = 3.0 -- at rest; the calibration needs 1.5

local kRoots = { 2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53 } -- square roots of primes have no common period

-- Angles of pose `i`, spread evenly over the limits; those of a base come first.
local function pose_deg(arm, i)
  local goal_deg, told_deg = {}, arm.state.setpoint_js_deg
  for k = 1, #told_deg - 2 * #arm.robot.segments do goal_deg[k] = told_deg[k] end
  for m, segment in ipairs(arm.robot.segments) do
    for k = 2 * m - 1, 2 * m do
      local share = 2 * ((i * math.sqrt(kRoots[k])) % 1) - 1
      goal_deg[#goal_deg + 1] = kShare * share * segment.theta_limit_deg
    end
  end
  return goal_deg
end

local function stood()
  local since_s
  return liana.condition(kStay_s .. " s at rest", function(arm)
    if not arm.state.at_rest or arm.state.is_busy then
      since_s = nil
      return false
    end
    since_s = since_s or arm.state.time_s
    return arm.state.time_s - since_s >= kStay_s
  end)
end

local steps = {}
for i = 1, kPoses do
  steps[i] = liana.step("pose " .. i) {
    device = "none",
    run = function(arm) arm.move_jp { goal_deg = pose_deg(arm, i) } end,
    exit = stood(),
    time_limit_s = 120,
    on_fail = "hold",
    next = i < kPoses and { step = "pose " .. i + 1, on = "failure" } or nil,
  }
end
return liana.mission "tracker_tour"(steps)
