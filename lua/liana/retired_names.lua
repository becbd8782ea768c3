-- Names that missions had before, with their present ones. An old name is refused with the present one; it does not work.
local retired = {
  step = { steer = "teleoperate" }, -- fields of a step
  actions = { push = "insert", follow = "comply" }, -- of `liana`, and functions of `arm`
}

-- ", which is called NEW now" for a retired name of `table`, else "".
function retired.hint(table, name)
  local new = retired[table][name]
  return new and ", which is called " .. new .. " now" or ""
end

-- Makes the old fields of a state refuse.
local kState = { push = "insert", torque_told_Nm = "torque_commanded_Nm" }
local of_state = {
  __index = function(_, name)
    local new = kState[name]
    if new then error("state." .. name .. " is called " .. new .. " now", 2) end
  end,
}
function retired.refuse_of_state(state) return setmetatable(state, of_state) end

-- Gives `target` functions of the old names, which refuse.
function retired.refuse_in(target)
  for old, new in pairs(retired.actions) do
    target[old] = function() error(old .. " is called " .. new .. " now: write " .. new, 2) end
  end
end

return retired
