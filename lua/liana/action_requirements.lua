-- What an action needs of the robot, as far as it is known before it runs, all optional:
-- { pose = name, command = "shape", fields = { ... }, is_for_cables = true }.
-- A mission is refused before it starts when the robot cannot do it. Of functions of your own nothing is known until they run.
local uses = {}

local used = {} -- action -> what it needs

-- Notes it and returns the action.
function uses.noted(action, what)
  used[action] = what
  return action
end

function uses.of(action) return used[action] or {} end

return uses
