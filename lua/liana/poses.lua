-- Which named poses of the robot an action uses, so that a mission is refused before it starts when the robot has none of that name.
local poses = {}

local used = {} -- action -> names

-- Notes the names and returns the action.
function poses.noted(action, ...)
  used[action] = { ... }
  return action
end

-- Names an action uses; none for functions of your own, which are found when they run.
function poses.of(action) return used[action] or {} end

return poses
