-- Runs a mission: one call per state from lianad (every command interval), never blocking.
-- boot -> (enter -> confirm -> run) for each step -> finish -> over; any fault leads through the step's on_fail to over,
-- with on_fail = "pause" to stuck, and from there on people's word through boot to the step again. People may pause it.
local view = require "liana.view"

local engine = {}

local kBootLimit_s = 60 -- drives boot, home and enable in this time or the mission fails
local kSettle_s = 0.1 -- commands need a few intervals before the state shows them
local kFinishLimit_s = 5
local kRetractStall_s = 60 -- the way back comes on by a point of its path in this time or the mission ends
local kPatience_s = 3600 -- of this time a mission waits for people at most
local kRetry_s = 2 -- between attempts that lianad answers with busy or refused

local Runner = {}
Runner.__index = Runner

-- The bindings, remembering in `pending` what lianad has not answered yet.
local function tracked(commands, pending)
  local out = {}
  for name, command in pairs(commands) do
    out[name] = function(fields)
      local id = command(fields or {})
      pending[id] = name
      return id
    end
  end
  return out
end

-- A runner for a checked mission. `native` has commands (the bindings), progress(event) and report(table); `name` is ours at lianad.
function engine.new(mission, welcome, native, name)
  local pending = {} -- request id -> command
  return setmetatable({
    mission = mission, native = native, name = name, arm = view.new(tracked(native.commands, pending), welcome),
    phase = "boot", index = 0, pending = pending, not_before = 0, first_retract_tick = nil, current_hold = {},
    index_to_begin = 1, single_step = false,
    boot_reason = "state_command got no refusal",
    report = { mission = mission.name, outcome = "failed", reason = "", steps = {}, duration_s = 0 },
  }, Runner)
end

function Runner:step() return self.mission.steps[self.index] end

function Runner:request(command, fields) self.arm[command](fields) end

function Runner:waiting()
  local count = 0
  for _ in pairs(self.pending) do count = count + 1 end
  return count > 0
end

function Runner:enter_phase(phase)
  self.phase = phase
  self.phase_tick = self.arm.state.tick
end

function Runner:phase_s() return self.arm.elapsed_s(self.phase_tick) end

-- ---- boot: own motion, home, enable -------------------------------------------------------------------------------

local function boot_request(runner)
  local state = runner.arm.state
  if not runner.owned then return "acquire" end
  if state.state == "DISABLED" and not state.is_homed then return "state_command", { command = "home" } end
  if state.state == "DISABLED" then return "state_command", { command = "enable" } end
end

-- Who stopped the arm, and why.
local function stop_text(stop)
  return "emergency stop by " .. stop.by .. (stop.reason ~= "" and ": " .. stop.reason or "")
end

local function boot(runner)
  local state = runner.arm.state
  if state.stop then return runner:fail("aborted", stop_text(state.stop) .. ", before the drives were enabled") end
  if state.state == "FAULT" then return runner:fail("failed", "drives in fault at start: " .. runner:fault_names()) end
  -- Somebody stopped the arm while it was being enabled: that is final, never enabled again by itself.
  if state.state == "STOPPING" then return runner:fail("aborted", "stopped while the drives were being enabled") end
  if runner:phase_s() > kBootLimit_s then return runner:fail("failed", ("not enabled after %g s, %s"):format(kBootLimit_s, runner.boot_reason)) end
  if state.state == "ENABLED" and runner.owned then return runner:begin_step(runner.index_to_begin, true) end
  if runner:waiting() or runner:phase_s() < runner.not_before then return end
  local command, fields = boot_request(runner)
  if command then
    runner:request(command, fields)
    runner.not_before = runner:phase_s() + kRetry_s
  end
end

-- ---- steps --------------------------------------------------------------------------------------------------------

local function held_list(hold)
  local held = {}
  for theta in pairs(hold) do held[#held + 1] = theta end
  return held
end

function Runner:begin_step(index, goes_on)
  self.index = index
  local step, state = self:step(), self.arm.state
  self.record = {
    name = step.name, device = step.device, held_theta = held_list(step.hold), outcome = "running", reason = "",
    start_tick = state.tick, end_tick = state.tick, duration_s = 0,
  }
  self.report.steps[index] = self.record
  self.refusals_before = state.refusals
  if step.on_fail == "retract" and not self.first_retract_tick then self.first_retract_tick = state.tick end
  self.arm.begin_tick, self.arm.was_engaged, self.arm.must_hold = state.tick, false, step.hold
  self.has_entered, self.is_confirmed, self.waited_s = false, step.confirm == nil, 0
  self:announce_step()
  self.native.progress { event = "begin", index = index, count = #self.mission.steps, name = step.name, device = step.device, time_s = state.time_s }
  self.native.report(self.report)
  self:enter_phase("enter")
  if self.single_step and not goes_on then self:pause("one step at a time") end
end

-- Tells everybody which step runs, and what it waits for.
function Runner:announce_step(waits)
  local step = self:step()
  self:request("announce", { step = { index = self.index, name = step.name, device = step.device, task = step.task, waits = waits } })
end

local function same_hold(a, b)
  for theta, target_deg in pairs(a) do if b[theta] ~= target_deg then return false end end
  for theta in pairs(b) do if a[theta] == nil then return false end end
  return true
end

function Runner:send_hold(hold)
  if same_hold(hold, self.current_hold) then return end
  local held = {}
  for theta, target_deg in pairs(hold) do held[#held + 1] = { theta = theta, target_deg = target_deg } end
  self:request("hold_theta", { held = held })
  self.current_hold = hold
end

local function enter(runner)
  local step = runner:step()
  if not runner.has_entered and not step.enter.met(runner.arm) then
    if runner:phase_s() > step.enter_limit_s then runner:fail("failed", "cannot enter, not met: " .. step.enter.text) end
    return
  end
  runner.has_entered = true
  if not runner.is_confirmed then return runner:wait_for_people("confirm", "confirm: " .. step.confirm) end
  runner:send_hold(step.hold)
  if step.device ~= "none" then
    local fields = { device = step.device }
    for field, value in pairs(step.steer) do fields[field] = value end
    runner:request("use_device", fields)
  end
  step.run(runner.arm)
  runner:enter_phase("run")
end

-- ---- people ---------------------------------------------------------------------------------------------------------

function Runner:wait_for_people(phase, why)
  self:announce_step((string.char(why:byte(1, 120)):gsub("[^\32-\126]", "?"))) -- no reason may keep lianad from taking it
  self.native.progress {
    event = "wait", index = self.index, count = #self.mission.steps, name = self:step().name, reason = why,
    time_s = self.arm.state.time_s,
  }
  self:enter_phase(phase)
end

-- The arm holds; nothing goes on until somebody says so. The step's time stands still.
function Runner:pause(why)
  self:request("hold")
  if self:step().device ~= "none" and self.phase == "run" then self:request("use_device", { device = "none" }) end
  self.current_hold = { paused = true } -- holds of its own: what was under way has to be asked for again
  self:wait_for_people("paused", "paused: " .. why)
end

function Runner:go_on()
  if self.phase == "stuck" then -- from the beginning of the step, as the owner of an arm that is enabled
    self.index_to_begin, self.not_before, self.failed_outcome, self.failed_reason = self.index, 0, nil, nil
    return self:enter_phase("boot")
  end
  self.waited_s = self.waited_s + self:phase_s()
  self.refusals_before = self.arm.state.refusals
  self:announce_step()
  self:enter_phase("enter")
end

local kUnderWay = { enter = true, confirm = true, run = true }
local kAsked = {}

function kAsked.pause(runner, by)
  if kUnderWay[runner.phase] then runner:pause("asked for by " .. by) end
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
  if kUnderWay[runner.phase] or runner.phase == "paused" then runner:fail("aborted", reason, true) end
end

-- What somebody has asked for since the last look (docs/api.md, mission_control).
function Runner:heed()
  local asked = self.arm.state.mission_control
  local number = asked and asked.number or 0
  if self.heard ~= nil and number > self.heard then kAsked[asked.command](self, asked.by) end
  self.heard = number
end

-- Waiting for people has an end, too.
local function wait(runner)
  if runner:phase_s() > kPatience_s then runner:fail("failed", ("nobody said how to go on within %g s"):format(kPatience_s), true) end
end

local function wait_stuck(runner)
  if runner:phase_s() <= kPatience_s then return end
  runner:over(runner.failed_outcome, ("%s; nobody said how to go on within %g s"):format(runner.failed_reason, kPatience_s))
end

-- ---- steps, again ---------------------------------------------------------------------------------------------------

-- A motion that the script asked for has ended before its goal. (While an operator steers, a refusal is part of steering.)
local function refused_motion(runner)
  local state = runner.arm.state
  if runner:step().device ~= "none" or state.refusals == runner.refusals_before then return false end
  runner:fail("refused", "lianad refused the motion: " .. state.verdict.text)
  return true
end

local function run(runner)
  local step, arm = runner:step(), runner.arm
  if refused_motion(runner) then return end
  local fresh = runner:phase_s() >= kSettle_s -- before, the state may still speak of the step before
  if fresh and arm.state.device_engaged then arm.was_engaged = true end
  if fresh and not runner:waiting() and step.exit.met(arm) then return runner:end_step() end
  if arm.elapsed_s(arm.begin_tick) - runner.waited_s > step.time_limit_s then
    local busy = arm.state.is_busy and " while the arm was still moving" or ""
    runner:fail("failed", ("time limit of %g s passed%s, not met: %s"):format(step.time_limit_s, busy, step.exit.text))
  end
end

function Runner:close_record(outcome, reason)
  local record, state = self.record, self.arm.state
  record.outcome, record.reason, record.end_tick = outcome, reason, state.tick
  record.duration_s = self.arm.elapsed_s(record.start_tick)
  self.native.progress {
    event = "end", index = self.index, count = #self.mission.steps, name = record.name, device = record.device, outcome = outcome,
    reason = reason, duration_s = record.duration_s, time_s = state.time_s,
  }
  self.native.report(self.report)
end

function Runner:end_step()
  self:close_record("success", "")
  if self:step().device ~= "none" then self:request("use_device", { device = "none" }) end
  if self.index < #self.mission.steps then return self:begin_step(self.index + 1) end
  self.report.repair_tick = self.arm.state.tick
  self.report.duration_s = self.arm.elapsed_s(self.report.steps[1].start_tick)
  self.mission.finish(self.arm)
  self:enter_phase("finish")
end

local function finish(runner)
  if not runner:waiting() then return runner:over("success", "") end
  if runner:phase_s() > kFinishLimit_s then runner:over("failed", "no answer to the last command") end
end

-- ---- failing ------------------------------------------------------------------------------------------------------

function Runner:fault_names()
  local names = {}
  for i, fault in ipairs(self.arm.state.faults) do names[i] = fault.number .. " " .. fault.name .. " " .. (fault.index or "") end
  return #names > 0 and table.concat(names, ", ") or "none named"
end

-- A reason that no limit on packets and no encoding can keep from lianad, which shows 200 bytes of it. The report has
-- the whole text.
local function short(reason)
  return (string.char(reason:byte(1, 200)):gsub("[^\32-\126]", "?"))
end

-- Ends the step with `outcome` and does what the step says; without a step, holds. `for_good`: does not wait for people.
function Runner:fail(outcome, reason, for_good)
  local step = self:step()
  if self.record and self.record.outcome == "running" then self:close_record(outcome, reason) end
  for id in pairs(self.pending) do self.pending[id] = nil end
  self.failed_outcome, self.failed_reason = outcome, reason
  local action = step and step.on_fail or "hold"
  if action == "pause" and not for_good then return self:get_stuck() end
  if action == "pause" then action = "hold" end
  if action == "retract" then
    self:request("retract", { until_tick = self.first_retract_tick })
    return self:enter_phase("retract")
  end
  if self.owned or action == "stop" then self:request(action, action == "stop" and { reason = short(reason) } or {}) end
  self:enter_phase("give_up")
end

-- The arm holds, and others may own motion meanwhile: to clear, to enable, to lead the arm back.
function Runner:get_stuck()
  self:wait_for_people("stuck", "failed: " .. self.failed_reason)
  if self.owned then self:request("release") end
  self.owned, self.current_hold = false, {}
end

-- The way back says by itself when it is over, and whether it went all the way. It has so many points and each in bounded time: it ends.
local function retract(runner)
  if runner:waiting() or runner:phase_s() < kSettle_s then return end
  local state = runner.arm.state
  local way = state.retract
  if way.phase == "done" then return runner:over("aborted", runner.failed_reason .. "; retracted along the verified path") end
  if way.phase == "ended" or way.phase == "none" then
    local text = "%s; the way back ended with %d points of the path to go: %s; the arm holds"
    return runner:over("failed", text:format(runner.failed_reason, way.points_left, way.reason))
  end
  if way.points_left ~= runner.points_left then runner.points_left, runner.progress_tick = way.points_left, state.tick end
  if runner.arm.elapsed_s(runner.progress_tick) > kRetractStall_s then
    runner.failed_outcome = "failed"
    runner.failed_reason = ("%s; not back along the verified path: no way on for %g s, %d points to go, the arm holds"):format(
      runner.failed_reason, kRetractStall_s, way.points_left)
    runner:request("hold")
    runner:enter_phase("give_up")
  end
end

local function give_up(runner)
  if not runner:waiting() or runner:phase_s() > kFinishLimit_s then runner:over(runner.failed_outcome, runner.failed_reason) end
end

function Runner:over(outcome, reason)
  self.report.outcome, self.report.reason = outcome, reason
  if self.report.repair_tick == nil and self.report.steps[1] then
    self.report.duration_s = self.arm.elapsed_s(self.report.steps[1].start_tick)
  end
  self.arm.announce {}
  if self.owned then self.arm.release {} end
  self.phase = "over"
  self.native.report(self.report)
end

-- ---- what lianad says ---------------------------------------------------------------------------------------------

-- The arm stopped by itself, by the operator or by a fault: nothing is left to command.
local function stopped(runner)
  local state = runner.arm.state
  if runner.phase == "boot" or runner.phase == "stuck" or state.state == "ENABLED" then return false end
  local outcome = #state.faults > 0 and "failed" or "aborted"
  local reason = ("the arm is %s (stop category %s), faults: %s"):format(state.state, state.stop_category, runner:fault_names())
  local stop = state.stop and stop_text(state.stop)
  if stop and not (runner.failed_reason or ""):find(stop, 1, true) then reason = stop .. ": " .. reason end
  if runner.failed_reason then reason = runner.failed_reason .. "; " .. reason end
  local step = runner:step()
  if not runner.failed_reason and not state.stop and step and step.on_fail == "pause" then
    runner:fail(outcome, reason)
    return true
  end
  if runner.record and runner.record.outcome == "running" then runner:close_record(outcome, reason) end
  runner:over(runner.failed_outcome or outcome, reason)
  return true
end

-- A fault that only holds the arm leaves it enabled and at rest, as if it had arrived.
local function held_by_fault(runner)
  local under_way = kUnderWay[runner.phase] or runner.phase == "finish"
  if not under_way or #runner.arm.state.faults == 0 then return false end
  runner:fail("failed", "fault " .. runner:fault_names())
  return true
end

local function lost(runner)
  local owner = runner.arm.state.owner
  return runner.owned and runner.phase ~= "boot" and owner ~= nil and owner ~= runner.name and owner ~= ""
end

-- While drives boot and lengths settle these answers are normal; kBootLimit_s bounds the patience.
local kBootRetry = { busy = true, refused = true }

local kPhases = {
  boot = boot, enter = enter, confirm = wait, paused = wait, stuck = wait_stuck, run = run, finish = finish,
  retract = retract, give_up = give_up,
}

-- One state message. Returns true when the mission is over.
function Runner:on_state(state)
  self.arm.state = state
  if not self.phase_tick then self.phase_tick = state.tick end
  if self.phase ~= "over" and not stopped(self) then
    if lost(self) then
      self.owned = false
      self:over("aborted", "motion belongs to " .. tostring(state.owner) .. " now")
    elseif not held_by_fault(self) then
      self:heed()
      if self.phase ~= "over" then kPhases[self.phase](self) end
    end
  end
  return self.phase == "over"
end

-- The answer to a request. `message` is ok or error as docs/api.md says.
function Runner:on_answer(message)
  local command = self.pending[message.id]
  self.pending[message.id] = nil
  if message.op == "ok" then
    if command == "acquire" then self.owned = true end
    return
  end
  if command == nil or self.phase == "stuck" then return end
  local reason = ("%s refused: %s: %s"):format(command, message.code, message.message)
  if self.phase == "boot" and kBootRetry[message.code] then
    self.boot_reason = reason
    return
  end
  if self.phase == "retract" or self.phase == "give_up" then
    self.failed_reason = self.failed_reason .. "; " .. reason
    return self:enter_phase("give_up")
  end
  self:fail("refused", reason)
end

return engine
