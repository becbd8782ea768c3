-- Names that missions had before, with their present ones. An old name is refused with the present one; it does not work.
local retired = {
  step = { steer = "teleoperate" }, -- fields of a step
}

-- ", which is called NEW now" for a retired name of `table`, else "".
function retired.hint(table, name)
  local new = retired[table][name]
  return new and ", which is called " .. new .. " now" or ""
end

return retired
