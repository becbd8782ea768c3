-- What of the station and of the ground the payload's mission needs and nothing simulates better: power, pressure, hatch, transfer
-- mechanism, self-tests, and a ground crew that looks at telemetry. Each takes its time, all of it assumed; what is asked for out of
-- order fails the step.
local liana = require "liana"

local station = {}

-- command = { state that it needs, as system = state; the state it leads to; seconds }
local kCommands = {
  ["power on"] = { needs = {}, system = "power", state = "on", takes_s = 3 },
  ["test arms"] = { needs = { power = "on" }, system = "arms", state = "tested", takes_s = 5 },
  ["equalise pressure"] = { needs = { power = "on" }, system = "pressure", state = "equal", takes_s = 10 },
  ["open hatch"] = { needs = { pressure = "equal" }, system = "hatch", state = "open", takes_s = 6 },
  ["mechanism out"] = { needs = { hatch = "open" }, system = "mechanism", state = "out", takes_s = 8 },
  ["open clamps"] = { needs = { mechanism = "out" }, system = "clamps", state = "open", takes_s = 2 },
  ["test payload"] = { needs = { power = "on" }, system = "payload", state = "tested", takes_s = 8 },
  ["mechanism in"] = { needs = { hatch = "open" }, system = "mechanism", state = "in", takes_s = 8 },
  ["close hatch"] = { needs = { mechanism = "in" }, system = "hatch", state = "closed", takes_s = 6 },
  ["power off"] = { needs = { hatch = "closed" }, system = "power", state = "off", takes_s = 2 },
}

local states = {} -- system -> { state, since tick, takes_s }

local function is(arm, system, state)
  local now = states[system]
  return now ~= nil and now.state == state and arm.elapsed_s(now.since) >= now.takes_s
end

-- An action: gives the command.
function station.command(name)
  local command = kCommands[name] or error("station: no command " .. tostring(name), 2)
  return function(arm)
    for system, state in pairs(command.needs) do
      if not is(arm, system, state) then error(("station: %s needs %s %s"):format(name, system, state), 0) end
    end
    states[command.system] = { state = command.state, since = arm.state.tick, takes_s = command.takes_s }
  end
end

-- A condition: what the command leads to is so.
function station.done(name)
  local command = kCommands[name] or error("station: no command " .. tostring(name), 2)
  return liana.condition(command.system .. " " .. command.state, function(arm) return is(arm, command.system, command.state) end)
end

local kLooks_s = 10 -- the ground looks at telemetry for so long before it says anything

-- A condition: the ground has seen `good` without a break for as long as it looks, or a person says `what`.
function station.ground_confirms(what, good)
  local said = liana.operator_says(what)
  local since
  return liana.condition("ground confirms " .. what, function(arm)
    if (said.met(arm)) then return true end
    if not good.met(arm) then since = nil return false end
    since = since or arm.state.tick
    if since < arm.begin_tick then since = arm.state.tick end
    return arm.elapsed_s(since) >= kLooks_s
  end)
end

return station
