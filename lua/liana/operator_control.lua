-- What people may do with a mission: pause it, resume it, take one step, confirm a step, abort; and the waiting for them, which has
-- an end, too. Part of the runner of lua/liana/engine.lua.
local people = { methods = {} }

people.kUnderWay = { enter = true, confirm = true, run = true } -- phases of a step that has begun and not ended

local kPatience_s = 3600 -- of this time a mission waits for people at most

function people.methods:wait_for_people(phase, why)
  self:announce_step(why)
  self.native.progress {
    event = "wait", index = self.index, count = #self.mission.steps, name = self:step().name, reason = why,
    time_s = self.arm.state.time_s,
  }
  self:enter_phase(phase)
end

function people.methods:stand_still()
  self:request("hold")
  if self:step().device ~= "none" and self.phase == "run" then self:request("use_device", { device = "none" }) end
  self.current_hold = { paused = true } -- holds of its own: what was under way has to be asked for again
end

-- The arm holds; nothing goes on until somebody says so. The step's time stands still.
function people.methods:pause(why)
  self:stand_still()
  self:wait_for_people("paused", "paused: " .. why)
end

function people.methods:go_on()
  if self.phase == "stuck" then -- from the beginning of the step, as the owner of an arm that is enabled
    self.index_to_begin, self.not_before, self.failed_outcome, self.failed_reason = self.index, 0, nil, nil
    return self:enter_phase("boot")
  end
  self.waited_s = self.waited_s + self:phase_s()
  self.refused_before = self.arm.state.refused_motions
  self:announce_step()
  self:enter_phase("enter")
end

local kAsked = {}

function kAsked.pause(runner, by)
  if people.kUnderWay[runner.phase] then runner:pause("asked for by " .. by) end
end

function kAsked.resume(runner)
  runner.single_step = false
  if runner.phase == "paused" or runner.phase == "stuck" then runner:go_on() end
end

-- The step under way, or the next one, and then a pause.
function kAsked.step(runner)
  runner.single_step = true
  if runner.phase == "paused" or runner.phase == "stuck" then runner:go_on() end
end

function kAsked.confirm(runner)
  if runner.phase ~= "confirm" then return end
  runner.is_confirmed, runner.waited_s = true, runner.waited_s + runner:phase_s()
  runner:announce_step()
  runner:enter_phase("enter")
end

function kAsked.abort(runner, by)
  local reason = "ended by " .. by
  if runner.phase == "stuck" then return runner:over(runner.failed_outcome, runner.failed_reason .. "; " .. reason) end
  if people.kUnderWay[runner.phase] or runner.phase == "recover" or runner.phase == "paused" then runner:fail("aborted", reason, true) end
end

-- What somebody has asked for since the last look (docs/reference/api.md, mission_control).
function people.methods:heed()
  local asked = self.arm.state.mission_control
  local number = asked and asked.number or 0
  if self.heard ~= nil and number > self.heard then kAsked[asked.command](self, asked.by) end
  self.heard = number
end

-- Waiting for people has an end, too.
function people.wait(runner)
  if runner:phase_s() > kPatience_s then runner:fail("failed", ("nobody said how to go on within %g s"):format(kPatience_s), true) end
end

function people.wait_stuck(runner)
  if runner:phase_s() <= kPatience_s then return end
  runner:over(runner.failed_outcome, ("%s; nobody said how to go on within %g s"):format(runner.failed_reason, kPatience_s))
end

return people
