-- Faults of the state message as people read them: those of one kind once, with the drives and buses that have them.

-- "a, b and c"
local function listed(texts)
  if #texts < 2 then return texts[1] or "" end
  return table.concat(texts, ", ", 1, #texts - 1) .. " and " .. texts[#texts]
end

-- "drives 4 (node 4, segment 2) and 5 (node 5, segment 2)"; of more than three drives the numbers only.
local function places_text(places)
  local drives = {}
  for i, place in ipairs(places) do
    drives[i] = place:match(#places > 3 and "^drive (%d+)" or "^drive (.+)$")
    if not drives[i] then return listed(places) end
  end
  return #places < 2 and listed(places) or "drives " .. listed(drives)
end

-- "3002 drive_silent: drives 4 (node 4, segment 2) and 5 (node 5, segment 2), 4001 bus_lost: bus can0".
return function(faults)
  local groups, of = {}, {}
  for _, fault in ipairs(faults) do
    local detail = fault.detail or 0
    local key = fault.number .. " " .. detail
    if not of[key] then
      of[key] = { title = fault.number .. " " .. fault.name, places = {}, detail = detail }
      groups[#groups + 1] = of[key]
    end
    if fault.where and fault.where ~= "" then table.insert(of[key].places, fault.where) end
  end
  local texts = {}
  for i, group in ipairs(groups) do
    local where = #group.places > 0 and ": " .. places_text(group.places) or ""
    texts[i] = group.title .. where .. (group.detail ~= 0 and " (detail " .. group.detail .. ")" or "")
  end
  return #texts > 0 and table.concat(texts, ", ") or "none named"
end
