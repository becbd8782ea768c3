-- Refuses an argument of a condition or action that is of another kind, at the user's line: need("at_pose", "name", name, "string").
local format_value = require "liana.format_value"

local kinds = {
  number = function(value) return type(value) == "number" and value - value == 0 end, -- neither infinite nor no number
}
kinds["number over 0"] = function(value) return kinds.number(value) and value > 0 end

return function(what, argument, value, kind)
  local is_one = kinds[kind]
  if is_one and is_one(value) or not is_one and type(value) == kind then return end
  error(("%s: %s: %s: allowed a %s: correct the call"):format(what, argument, format_value(value), kind), 3)
end
