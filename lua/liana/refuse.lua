-- Refuses a mission: where, field, value, what is allowed, what to do.
local shown = require "liana.shown"

return function(where, field, value, allowed, advice)
  error(where .. ": " .. field .. ": " .. shown(value) .. ": allowed " .. allowed .. ": " .. advice, 0)
end
