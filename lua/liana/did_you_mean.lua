-- Which name of a closed list somebody meant who wrote an unknown one.
local kEdits = 2 -- letters added, left out or replaced, and at most half of those given

local function edits_between(a, b)
  local row = {}
  for j = 0, #b do row[j] = j end
  for i = 1, #a do
    local before = row[0]
    row[0] = i
    for j = 1, #b do
      local replaced = before + (a:byte(i) == b:byte(j) and 0 or 1)
      before = row[j]
      row[j] = math.min(replaced, row[j] + 1, row[j - 1] + 1)
    end
  end
  return row[#b]
end

-- "; did you mean NAME?", for the end of what is allowed; empty where none of `names` is near to `given`.
return function(given, names)
  if type(given) ~= "string" or #given > 80 then return "" end
  local nearest, fewest = nil, math.min(kEdits, #given // 2) + 1
  for _, name in ipairs(names) do
    local edits = edits_between(given, name)
    if edits < fewest then nearest, fewest = name, edits end
  end
  return nearest and "; did you mean " .. nearest .. "?" or ""
end
