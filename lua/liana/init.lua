-- What a mission is written with: `local liana = require "liana"`.
--
--   return liana.mission "name" {
--     step "first" { device = "none", run = move_to "prepare", exit = at_pose "prepare", time_limit_s = 60, on_fail = "hold" },
--     ...
--     finish = tool "repair",
--   }
--
-- Steps run in the order in which they are written. lua/README.md says what each field means.
local actions = require "liana.actions"
local check = require "liana.check"
local conditions = require "liana.conditions"

local liana = {}

for name, action in pairs(actions) do liana[name] = action end
for name, condition in pairs(conditions) do liana[name] = condition end

-- A step: a name, then its fields (lua/liana/check.lua lists them).
function liana.step(name)
  return function(fields)
    fields.name = name
    return fields
  end
end

-- A mission: a name, then its steps in order, and what to do at the end. Refuses anything it does not know.
function liana.mission(name)
  return function(fields) return check.mission(name, fields) end
end

return liana
