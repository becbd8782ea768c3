-- For an arm that was parked in its fixture: one angle a little on.
local liana = require "liana"

local kTheta = 9
local kGoal_deg = -10.5

local function small_move(arm)
  local goal_deg = {}
  for i, angle_deg in ipairs(arm.named_pose "jig") do goal_deg[i] = angle_deg end
  goal_deg[kTheta] = kGoal_deg
  arm.move_jp { goal_deg = goal_deg }
end

local there = liana.condition("theta_9 at its goal", function(arm) return math.abs(arm.state.setpoint_js_deg[kTheta] - kGoal_deg) < 0.01 end)

return liana.mission "out_of_fixture" {
  liana.step "a small move" {
    device = "none",
    run = small_move,
    exit = liana.all { there, liana.at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },
}
