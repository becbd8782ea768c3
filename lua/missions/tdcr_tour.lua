-- The first mission of tdcr_benchmark, by its joints alone: `liana run tdcr_tour`.
local liana = require "liana"
local step, all = liana.step, liana.all

local function pose_step(name)
  return step("pose " .. name) {
    device = "none",
    run = liana.move_to(name),
    exit = all { liana.at_pose(name, 0.5), liana.at_rest() },
    time_limit_s = 60,
    on_fail = "retract",
  }
end

return liana.mission "tdcr_tour" {
  robot = "tdcr_benchmark",
  scene = "none",
  pose_step "hook",
  pose_step "left",
  pose_step "right",
  pose_step "zero",
}
