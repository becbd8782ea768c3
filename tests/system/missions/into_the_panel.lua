-- From the prepare pose straight towards the panel, past the slit: verification refuses it on the way.
local liana = require "liana"

local kTheta = { 8, 10 } -- yaws of segments 4 and 5
local kTurn_deg = -15

local function towards_the_panel(arm)
  local goal_deg = {}
  for i, angle_deg in ipairs(arm.named_pose "panel_edge") do goal_deg[i] = angle_deg end
  for _, theta in ipairs(kTheta) do goal_deg[theta] = goal_deg[theta] + kTurn_deg end
  arm.move_jp { goal_deg = goal_deg }
end

return liana.mission "into_the_panel" {
  liana.step "prepare" {
    device = "none",
    run = liana.move_to "prepare",
    exit = liana.all { liana.at_pose "prepare", liana.at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },
  liana.step "towards the panel" {
    device = "none",
    run = towards_the_panel,
    exit = liana.at_pose "panel_edge",
    time_limit_s = 20,
    on_fail = "hold",
  },
  finish = liana.tool "none",
}
