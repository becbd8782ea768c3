-- Refuses a mission: where, field, value, what is allowed, what to do.
return function(where, field, value, allowed, advice)
  error(where .. ": " .. field .. ": " .. tostring(value) .. ": allowed " .. allowed .. ": " .. advice, 0)
end
