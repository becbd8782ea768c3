-- What the mission lab_search is made of: conditions and an action of its own.
local liana = require "liana"

local parts = {}

-- Any cable tenser than most_N.
function parts.tension_over(most_N)
  return liana.condition(("a cable over %g N"):format(most_N), function(arm)
    for _, tension_N in ipairs(arm.state.tension_N) do
      if tension_N > most_N then return true end
    end
    return false
  end)
end

-- So long after the step began.
function parts.after_s(seconds)
  return liana.condition(("%g s passed"):format(seconds), function(arm) return arm.elapsed_s(arm.begin_tick) > seconds end)
end

-- Turns one angle of a named pose by by_deg, and by -by_deg the next time.
function parts.sway(pose, angle, by_deg)
  return function(arm)
    local goal_deg = {}
    for i, angle_deg in ipairs(arm.named_pose(pose)) do goal_deg[i] = angle_deg end
    goal_deg[angle] = goal_deg[angle] + by_deg
    by_deg = -by_deg
    arm.move_jp { goal_deg = goal_deg }
  end
end

return parts
