-- What a mission is written with: `local liana = require "liana"`.
--
--   return liana.mission "name" {
--     step "first" { device = "none", run = move_to "prepare", exit = at_pose "prepare", time_limit_s = 60, on_fail = "hold" },
--     ...
--     finish = tool "repair",
--   }
--
-- Steps run in the order in which they are written, or as their `next` says. docs/reference/mission-language.md says what
-- each field means.
local actions = require "liana.actions"
local check = require "liana.check"
local conditions = require "liana.conditions"
local position = require "liana.position"
local retired = require "liana.retired_names"

local liana = {}

for name, action in pairs(actions) do liana[name] = action end
for name, condition in pairs(conditions) do liana[name] = condition end
retired.refuse_in(liana)

-- A step: a name, then its fields (lua/liana/check.lua lists them).
function liana.step(name)
  local at = position(1)
  return function(fields)
    if type(fields) ~= "table" then error("step: fields: " .. type(fields) .. ": allowed step \"name\" { ... }: correct the call", 2) end
    fields.name, fields.at = name, at
    return fields
  end
end

-- A mission: a name, then its steps in order, what to do at the end (`finish`), and the tables that it runs with where nobody names others
-- (`robot`, `scene`, `bus`). Refuses anything it does not know.
function liana.mission(name)
  local at = position(1)
  return function(fields) return check.mission(name, fields, at) end
end

return liana
