-- A search with three_segment_lab: along a planned way to a place, three looks around there, and home, gently where the
-- cables have become taut. `liana run lab_search`.
--
-- It shows what docs/how-to/write-a-mission.md tells of: a plan as a step, fail_when, a loop, a branch, a way on after
-- a failure, and a module beside the mission (lab_search/parts.lua).
local liana = require "liana"
local parts = require "lab_search.parts"
local all = liana.all
local move_to, at_pose, at_rest = liana.move_to, liana.at_pose, liana.at_rest

-- Numbers to tune.
local kTolerance_deg = 0.5
local kMaxTension_N = 100 -- beyond it a look is given up
local kCalm_N = 60 -- up to it the arm goes home at full rate
local kLooksAgain = 2
local kGentleRate_deg_s = 1

local function home(rate_deg_s, next)
  return {
    device = "none",
    run = move_to("park", rate_deg_s),
    exit = all { at_pose("park", kTolerance_deg), at_rest() },
    time_limit_s = 90,
    on_fail = "retract",
    next = next,
  }
end

return liana.mission "lab_search" {
  robot = "three_segment_lab",
  scene = "lab_box",

  liana.step "to where the plan begins" {
    device = "none",
    run = move_to "park",
    exit = all { at_pose("park", kTolerance_deg), at_rest() },
    time_limit_s = 60,
    on_fail = "hold",
  },

  liana.step "along the plan" {
    device = "none",
    plan = "lab_search/way.json", -- liana plan --robot three_segment_lab --scene lab_box, from park to look
    time_limit_s = 120,
    on_fail = "retract",
  },

  liana.step "look around" {
    device = "none",
    run = parts.sway("look", 2, 3), -- angle 2 by 3 deg, to the other side every time
    exit = all { at_rest(), parts.after_s(1) },
    fail_when = parts.tension_over(kMaxTension_N),
    time_limit_s = 60,
    on_fail = "retract",
    next = {
      { step = "look around", at_most = kLooksAgain },
      { step = "home gently", when = parts.tension_over(kCalm_N) },
      { step = "home gently", on = "failure" },
    },
  },

  liana.step "home" (home(nil, "finish")),

  liana.step "home gently" (home(kGentleRate_deg_s)),
}
