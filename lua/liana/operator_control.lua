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
  if self.failed_reason and self.phase == "paused" then -- on the way back
    self:announce_step()
    return self:go_back()
  end
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

local kStepFollows = { boot = true, recover = true } -- phases before a step, which a pause lets begin and no more

function kAsked.pause(runner, by)
  if kStepFollows[runner.phase] then runner.pause_by = by end
  if people.kUnderWay[runner.phase] or runner.phase == "retract" then runner:pause("asked for by " .. by) end
end

function kAsked.resume(runner)
  runner.single_step, runner.pause_by = false, nil
  if runner.phase == "paused" or runner.phase == "stuck" then runner:go_on() end
end

-- The step under way, or the next one, and then a pause.
function kAsked.step(runner)
  runner.single_step, runner.pause_by = true, nil
  if runner.phase == "paused" or runner.phase == "stuck" then runner:go_on() end
end

function kAsked.confirm(runner)
  if runner.phase ~= "confirm" then return end
  runner.is_confirmed, runner.waited_s = true, runner.waited_s + runner:phase_s()
  runner:announce_step()
  runner:enter_phase("enter")
end

-- A paused step fails; a paused way back goes on, for it is what the step's failure has led to.
local function end_pause(runner, outcome, reason)
  if runner.failed_reason then return runner:go_on() end
  runner:fail(outcome, reason, true)
end

local kTakesPower = { DISABLED = true, ENABLING = true } -- states in which this runner's `enable` may be under way

function kAsked.abort(runner, by)
  local phase, reason = runner.phase, "ended by " .. by
  if phase == "stuck" then return runner:over(runner.failed_outcome, runner.failed_reason .. "; " .. reason) end
  if phase == "paused" then return end_pause(runner, "aborted", reason) end
  if phase == "boot" and runner.owned and kTakesPower[runner.arm.state.state] then runner:request("state_command", { command = "disable" }) end
  if phase == "boot" or phase == "finish" then return runner:over("aborted", reason) end -- no step is under way: the arm holds
  if people.kUnderWay[phase] or phase == "recover" then runner:fail("aborted", reason, true) end
end

-- What somebody has asked this mission for since the last look (docs/reference/api.md, mission_control).
function people.methods:heed()
  local asked = self.arm.state.mission_control
  local number = asked and asked.number or 0
  if number > self.heard then
    self.heard = number
    kAsked[asked.command](self, asked.by)
  end
end

-- Waiting for people has an end, too.
function people.wait(runner)
  if runner:phase_s() > kPatience_s then end_pause(runner, "failed", ("nobody said how to go on within %g s"):format(kPatience_s)) end
end

function people.wait_stuck(runner)
  if runner:phase_s() <= kPatience_s then return end
  runner:over(runner.failed_outcome, ("%s; nobody said how to go on within %g s"):format(runner.failed_reason, kPatience_s))
end

return people
