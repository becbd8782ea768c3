-- Refuses a mission: where, field, value, what is allowed, what to do.
local format_value = require "liana.format_value"

return function(where, field, value, allowed, advice)
  error(where .. ": " .. field .. ": " .. format_value(value) .. ": allowed " .. allowed .. ": " .. advice, 0)
end
