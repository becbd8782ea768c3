-- Runs a mission: one call per state from lianad (every command interval), never blocking.
-- boot -> (enter -> confirm -> run) for each step -> finish -> over; which step is next, lua/liana/transitions.lua says. Any fault
-- leads through the step's on_fail to over, with on_fail = "pause" to stuck, and from there on people's word through boot to
-- the step again; a failure that `next` has a way for leads through recover to that step. People may pause it.
local check = require "liana.check"
local fault_text = require "liana.fault_text"
local operator_control = require "liana.operator_control"
local arm_state = require "liana.arm_state"
local retired = require "liana.retired_names"
local transitions = require "liana.transitions"

local engine = {}

local kBootLimit_s = 60 -- drives boot, home and enable in this time or the mission fails
local kSettle_s = 0.1 -- commands need a few intervals before the state shows them
local kFinishLimit_s = 5
local kToolLimit_s = 30 -- the tool says in this time how its last command ended
local kRetractStall_s = 60 -- the way back comes on by a point of its path in this time or the mission ends
local kMostSteps = 1000 -- begin in one run
local kRecoverLimit_s = 30 -- the arm is at rest in this time after a failed step that another one follows
local kLeastShare = 0.1 -- of a step's time counts, however much the arm is slowed: a step ends
local kRetry_s = 2 -- between attempts that lianad answers with busy or refused

local Runner = {}
Runner.__index = Runner
for name, method in pairs(operator_control.methods) do Runner[name] = method end

-- Where a motion is to end: { joints_deg } or { tip }; nothing for other commands.
local function goal_of(name, fields)
  if name == "move_jp" then return { joints_deg = fields.goal_deg } end
  if name == "move_cp" then return { tip = fields.goal } end
  if name == "move_path" then return { joints_deg = fields.points_deg[#fields.points_deg] } end
end

-- The bindings, remembering in `pending` what lianad has not answered yet, and by `note` where a motion is to end.
local function tracked(commands, pending, note)
  local out = {}
  for name, command in pairs(commands) do
    out[name] = function(fields)
      local id = command(fields or {})
      note(goal_of(name, fields))
      pending[id] = name
      return id
    end
  end
  return out
end

-- A runner for a checked mission. `native` has commands (the bindings), progress(event), report(table), plan_curve(request) and
-- attempt(function, ...), which is pcall with a budget of its own; `name` is ours at lianad. In a rehearsal nobody is there.
function engine.new(mission, welcome, native, name, is_rehearsal)
  local pending = {} -- request id -> command
  local arm
  arm = arm_state.new(tracked(native.commands, pending, function(goal) arm.goal = goal or arm.goal end), welcome)
  arm.plan_curve = native.plan_curve
  return setmetatable({
    mission = mission, native = native, name = name, arm = arm, is_rehearsal = is_rehearsal,
    phase = "boot", index = 0, pending = pending, not_before = 0, first_retract_tick = nil, current_hold = {},
    index_to_begin = 1, single_step = false, heard = 0, taken = {}, -- of each way how often
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

-- The report, of its steps only the last two: those before do not change any more.
function Runner:tell_report()
  local steps, told = self.report.steps, {}
  for name, value in pairs(self.report) do told[name] = value end
  told.steps_before = math.max(0, #steps - 2)
  told.steps = { table.unpack(steps, told.steps_before + 1) }
  self.native.report(told)
end

function Runner:begin_step(index, goes_on)
  if #self.report.steps >= kMostSteps then return self:fail("failed", ("%d steps have begun, more than a run may have"):format(kMostSteps)) end
  self.index = index
  local step, state = self:step(), self.arm.state
  self.record = {
    index = index, name = step.name, device = step.device, held_theta = held_list(step.hold), outcome = "running", reason = "", ended_by = "",
    start_tick = state.tick, end_tick = state.tick, duration_s = 0, slowed_s = 0,
  }
  self.report.steps[#self.report.steps + 1] = self.record
  self.refused_before = state.refused_motions
  if step.on_fail == "retract" and not self.first_retract_tick then self.first_retract_tick = state.tick end
  self.arm.begin_tick, self.arm.was_engaged, self.arm.must_hold = state.tick, false, step.hold
  self.arm.goal = nil
  self.has_entered, self.is_confirmed, self.waited_s, self.slowed_s = false, step.confirm == nil, 0, 0
  self:announce_step(nil, self:after())
  self.native.progress { event = "begin", index = index, count = #self.mission.steps, name = step.name, device = step.device, time_s = state.time_s }
  self:tell_report()
  self:enter_phase("enter")
  local by = self.pause_by
  self.pause_by = nil
  if by then return self:pause("asked for by " .. by) end
  if self.single_step and not goes_on then self:pause("one step at a time") end
end

local kLongestText = 120 -- of what lianad is told about steps [bytes]

-- The beginning of a text of the script's, at most `length` bytes, that no limit on packets and no encoding keeps from lianad.
local function printable(text, length) return (text:sub(1, length):gsub("[^\32-\126]", "?")) end

-- Tells everybody which step runs, what it waits for, and what ended the one before.
function Runner:announce_step(waits, after)
  local step = self:step()
  local told = { index = self.index, name = step.name, device = step.device, task = step.task, entry = #self.report.steps }
  told.waits = waits and printable(waits, kLongestText)
  self:request("announce", { step = told, after = after })
end

-- What ended the step before, as lianad is told.
function Runner:after()
  if self.ended_by == nil then return nil end
  return printable(self.ended_by, kLongestText)
end

function Runner:send_hold(hold)
  if self.arm.robot.kind == "serial" then return end -- it holds no angles
  if transitions.same_hold(hold, self.current_hold) then return end
  local held = {}
  for theta, target_deg in pairs(hold) do held[#held + 1] = { theta = theta, target_deg = target_deg } end
  self:request("hold_theta", { held = held })
  self.current_hold = hold
end

-- Calls what the script has for `field`: whether that went well, and what it returned. An error in it fails the step.
function Runner:call(field, script)
  local is_fine, result, more = self.native.attempt(script, self.arm)
  if not is_fine then self:fail("failed", ("error in %s: %s"):format(field, result)) end
  return is_fine, result, more
end

-- Whether a condition of the step is met, and what of it; nothing of it after an error.
function Runner:is_met(field)
  local condition = self:step()[field]
  local is_fine, met, what = self:call(field, condition.met)
  if not (is_fine and met) then return false, nil, is_fine end
  return true, what or condition.text, true
end

local function enter(runner)
  local step = runner:step()
  if not runner.has_entered then
    local is_met, _, is_fine = runner:is_met("enter")
    if is_fine and not is_met and runner:phase_s() > step.enter_limit_s then
      runner:fall_short("failed", "cannot enter, not met: " .. step.enter.text)
    end
    if not is_met then return end
  end
  runner.has_entered = true
  if not runner.is_confirmed and not runner.is_rehearsal then return runner:wait_for_people("confirm", "confirm: " .. step.confirm) end
  runner:send_hold(step.hold)
  if step.device ~= "none" then runner:request("use_device", check.use_of(step)) end
  if runner:call("run", step.run) then runner:enter_phase("run") end
end

-- ---- steps, again ---------------------------------------------------------------------------------------------------

-- A motion that the script asked for has ended before its goal. (While an operator steers, a refusal is part of steering.)
local function refused_motion(runner)
  local state = runner.arm.state
  if runner:step().device ~= "none" or state.refused_motions == runner.refused_before then return false end
  runner:fall_short("refused", "lianad refused the motion: " .. state.verdict.text)
  return true
end

-- Looks at `fail_when`, then at `exit`. True when one of them, or an error in it, has ended the step.
local function ended_by_condition(runner)
  local has_failed, why, is_fine = runner:is_met("fail_when")
  if has_failed then runner:fall_short("failed", "fail_when: " .. why, why) end
  if has_failed or not is_fine then return true end
  if runner:waiting() then return false end
  local is_over, what, is_well = runner:is_met("exit")
  if is_over then runner:end_step(what) end
  return is_over or not is_well
end

-- How much of this state's time does not count for the step's limit: while lianad lets the hand lead the arm at a share of its
-- speed, that share of the time counts.
local function slowed_s(runner, state)
  local guidance = state.guidance
  local share = guidance and guidance.speed_share or 1
  return (1 - math.max(kLeastShare, math.min(1, share))) * (state.tick - runner.tick_before) * runner.arm.period_s
end

local function past_its_time(runner)
  local step, arm = runner:step(), runner.arm
  if arm.elapsed_s(arm.begin_tick) - runner.waited_s - runner.slowed_s <= step.time_limit_s then return end
  local slowed = runner.slowed_s >= 0.1 and (" and %.1f s more for an arm that was slowed"):format(runner.slowed_s) or ""
  local busy = arm.state.is_busy and " while the arm was still moving" or ""
  runner:fall_short("failed", ("time limit of %g s%s passed%s, not met: %s"):format(step.time_limit_s, slowed, busy, step.exit.text))
end

local function run(runner)
  local arm = runner.arm
  if refused_motion(runner) then return end
  local fresh = runner:phase_s() >= kSettle_s -- before, the state may still speak of the step before
  if fresh and arm.state.device_engaged then arm.was_engaged = true end
  if fresh and ended_by_condition(runner) then return end
  runner.slowed_s = runner.slowed_s + slowed_s(runner, arm.state)
  past_its_time(runner)
end

-- `ended_by`: the condition that ended the step, where one did.
function Runner:close_record(outcome, reason, ended_by)
  local record, state = self.record, self.arm.state
  record.outcome, record.reason, record.ended_by, record.end_tick = outcome, reason, ended_by or "", state.tick
  self.ended_by = ended_by
  record.duration_s, record.slowed_s = self.arm.elapsed_s(record.start_tick), self.slowed_s
  self.native.progress {
    event = "end", index = self.index, count = #self.mission.steps, name = record.name, device = record.device, outcome = outcome,
    reason = reason, ended_by = record.ended_by, duration_s = record.duration_s, time_s = state.time_s,
  }
  self:tell_report()
end

function Runner:end_step(ended_by)
  self:close_record("success", "", ended_by)
  if self:step().device ~= "none" then self:request("use_device", { device = "none" }) end
  local target, is_fine = self:way_on("success")
  if is_fine then self:go_to(target or self.index + 1) end
end

-- The step that `next` leads to on this outcome, if it does, and whether no condition in it has failed.
function Runner:way_on(outcome)
  for _, way in ipairs(self:step().ways) do
    if way.on == outcome and (way.at_most == nil or (self.taken[way] or 0) < way.at_most) then
      local is_fine, is_met = true, true
      if way.when then is_fine, is_met = self:call("next", way.when.met) end
      if not is_fine then return nil, false end
      if is_met then
        self.taken[way] = (self.taken[way] or 0) + 1
        self.record.next = way.step
        return way.target, true
      end
    end
  end
  return nil, true
end

-- To step `index`, or to the end behind the last.
function Runner:go_to(index)
  if index <= #self.mission.steps then return self:begin_step(index) end
  self.report.repair_tick = self.arm.state.tick
  self.report.duration_s = self.arm.elapsed_s(self.report.steps[1].start_tick)
  self.tool_number = self.arm.state.tool and self.arm.state.tool.number or 0
  if self:call("finish", self.mission.finish) then self:enter_phase("finish") end
end

local kToolUnderWay = { asked = true, acting = true }

-- What the mission ends with is over when lianad has taken it; a command to the tool when the tool has carried it out.
local function finish(runner)
  if runner:waiting() then
    if runner:phase_s() > kFinishLimit_s then runner:over("failed", "no answer to the last command") end
    return
  end
  if runner:phase_s() < kSettle_s then return end -- the state may still be from before
  local tool = runner.arm.state.tool
  if not tool or tool.number == runner.tool_number or tool.phase == "done" then return runner:over("success", "") end
  if not kToolUnderWay[tool.phase] then return runner:over("failed", ("tool: %s %s: %s"):format(tool.command, tool.phase, tool.reason)) end
  if runner:phase_s() > kToolLimit_s then
    runner:over("failed", ("tool: %s did not end within %g s; it is %s"):format(tool.command, kToolLimit_s, tool.phase))
  end
end

-- The step has not done what it should: on to where `next` leads then, at rest first, or else what on_fail says.
function Runner:fall_short(outcome, reason, ended_by)
  self:close_record(outcome, reason, ended_by)
  local target, is_fine = self:way_on("failure")
  if not is_fine then return end
  if not target then return self:fail(outcome, reason) end
  self:forget_requests()
  self:stand_still()
  self.failed_outcome, self.failed_reason, self.recovers_to = outcome, reason, target
  self:enter_phase("recover")
end

local function recover(runner)
  if runner:phase_s() > kRecoverLimit_s then
    return runner:fail("failed", ("%s; not at rest %g s after that"):format(runner.failed_reason, kRecoverLimit_s))
  end
  if runner:waiting() or runner:phase_s() < kSettle_s or not runner.arm.state.at_rest then return end
  runner.failed_outcome, runner.failed_reason = nil, nil
  runner:go_to(runner.recovers_to)
end

-- ---- failing ------------------------------------------------------------------------------------------------------

function Runner:fault_names()
  return fault_text(self.arm.state.faults)
end

-- Answers that still come are those of a step that is over.
function Runner:forget_requests()
  for id in pairs(self.pending) do self.pending[id] = nil end
end

-- Ends the step with `outcome` and does what the step says; without a step, holds. `for_good`: does not wait for people.
-- `ended_by` as for close_record.
function Runner:fail(outcome, reason, for_good, ended_by)
  local step = self:step()
  if self.record and self.record.outcome == "running" then self:close_record(outcome, reason, ended_by) end
  self:forget_requests()
  self.failed_outcome, self.failed_reason = outcome, reason
  local action = step and step.on_fail or "hold"
  if action == "pause" and not for_good then return self:get_stuck() end
  if action == "pause" then action = "hold" end
  if action == "retract" then return self:go_back() end
  if self.owned or action == "stop" then self:request(action, action == "stop" and { reason = printable(reason, 200) } or {}) end
  self:enter_phase("give_up")
end

function Runner:go_back()
  self.points_left = nil
  self:request("retract", { until_tick = self.first_retract_tick })
  self:enter_phase("retract")
end

-- The arm holds, and others may own motion meanwhile: to clear, to enable, to lead the arm back.
function Runner:get_stuck()
  if self.is_rehearsal then return self:over(self.failed_outcome, self.failed_reason .. "; the mission would wait for people here") end
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
  self.arm.announce { after = self:after() }
  if self.owned then self.arm.release {} end
  self.phase = "over"
  self:tell_report()
end

-- ---- what lianad says ---------------------------------------------------------------------------------------------

-- The arm stopped by itself, by the operator or by a fault: nothing is left to command.
local function stopped(runner)
  local state = runner.arm.state
  if runner.phase == "boot" or runner.phase == "stuck" or state.state == "ENABLED" then return false end
  local outcome = #state.faults > 0 and "failed" or "aborted"
  local faults = #state.faults > 0 and ", faults: " .. runner:fault_names() or ""
  local reason = ("the arm is %s (stop category %s)%s"):format(state.state, state.stop_category, faults)
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
  local under_way = operator_control.kUnderWay[runner.phase] or runner.phase == "recover" or runner.phase == "finish"
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
  boot = boot, enter = enter, confirm = operator_control.wait, paused = operator_control.wait, stuck = operator_control.wait_stuck,
  run = run, recover = recover, finish = finish,
  retract = retract, give_up = give_up,
}

-- One state message. Returns true when the mission is over.
function Runner:on_state(state)
  self.tick_before = self.arm.state and self.arm.state.tick or state.tick
  self.arm.state = retired.refuse_of_state(state)
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

-- The answer to a request. `message` is ok or error as docs/reference/api.md says.
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
  if operator_control.kUnderWay[self.phase] then return self:fall_short("refused", reason) end
  self:fail("refused", reason)
end

return engine
