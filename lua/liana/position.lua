-- Where a call stands in a script: position(1) in a function is the line that called it, "given.lua:3: ", and empty where
-- nobody knows, as error(text, 2) there would say it.
return function(level)
  local _, where = pcall(error, "", level + 3) -- above pcall, this function and the one that asks
  return where
end
