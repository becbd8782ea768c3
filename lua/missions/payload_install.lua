-- A payload is installed by the small arm on the locked large one (Liu et al., 2022): preparation, out of the airlock, the arms' operations,
-- self-test and restoring. `liana run payload_install`.
--
-- What goes wrong has a way of its own: a target that is lost or not reached, a jam, no capture, a capture that is told before any contact or
-- with pins that are not in, an adapter that falls silent: back off and try again, so often. A lock that does not close is tried again. A sensor
-- or a drive that fails latches a fault; that, a latch that has failed, and a payload that is latched and not told to be captured: the arm
-- holds, and the ground decides. `--fault NAME` exercises each (payload_install/faults). `source` marks what the paper states.
local liana = require "liana"
local geometry = require "liana.geometry"
local station = require "payload_install.station"
local step, all, any, condition = liana.step, liana.all, liana.any, liana.condition
local at_rest, servo_done, servo_failed = liana.at_rest, liana.servo_done, liana.servo_failed

-- Numbers to tune. The way in is the z of tip, payload and adapter.
local kNearPick_deg, kNearSite_deg = 30, 10 -- of the first joint, from `install`: where joint motion ends and lines begin
local kBeforeMechanism_m = 0.2 -- of the tip from the grapple, where the servo takes over
local kAtGrapple_m = 0.003 -- of the tip before the grapple's face; the end effector takes what is within 20 mm
local kRetreat_m = 0.5 -- out of the transfer mechanism
local kBeforeSite_m = { 0.015, 0.020, -0.53 } -- source: off the place in which the servo ends, 608 mm between the faces
local kBeforeAdapter_m = 0.008 -- of the pins' tips from the socket's face, where force control takes over: inside the funnels
local kBackOff_m = 0.05
local kCarryLimit_s = 600 -- the large arm takes 240 s
local kForce_N = 30 -- source
local kMostTravel_m, kMostAside_m = 0.08, 0.03 -- of a push, from as far beside the axis as a funnel takes
-- The way in of a push that nothing has aligned to so much, and of one after another that failed: it may meet the wall of a funnel, and a
-- payload of a ton at 5 mm/s gives a stiff one 100 N.
local kAligned_m, kGently = 0.005, { axial_damping_Ns_per_m = 4200 }
local kPushLimit_s, kGentleLimit_s = 40, 60 -- a push that has not captured by then is jammed; source: 7 to 8 s
local kAlmostIn_s = 20 -- more, for one with every pin in but for the last bit: the latch would close while the arm backs off
local kTries = 2 -- more, after the first
local kIn_m = 0.018 -- what every pin's sensor reads of a payload that is captured; the adapter itself wants 19.5 mm
local kHeard_s = 0.1 -- since the adapter's last message
local kLight_N = 5 -- what the adapter may still feel 1 s after the capture
local kLockLimit_s = 400 -- source: 298 s
-- With which periods the locked large arm swings under the small one, alone and with the payload of the scene in hand: what moves is led so
-- that it leaves the base still, whatever it carries. The squares of the periods grow with the mass, and with how far the locked joints give way.
-- `liana robot check macro_micro --scene payload_adapter` tells them.
local kGivesWay_Nm_per_rad = 4264 -- per joint, with which these are true
local kAlone_s, kAloneQuicker_s = 26.7, 5.6
local kHeavier = 1.055 -- the middle of the periods that payloads of 0.6 to 2 of their drawn mass swing with, on bases of 0.8 to 1.2 stiffness
local kSlowest_s2_per_kg, kQuickest_s2_per_kg = 0.9, 0.1
-- The end effector takes what is within 20 mm, a pin's funnel what is within 30 mm. With the payload in hand the arm is as heavy as what it
-- stands on: there it keeps still against a swing instead of working against it.
local kServoToPayload = { axis = "z", tolerance_m = 0.003, tolerance_deg = 0.8 } -- else as servo_target has it
local kServoToAdapter = { axis = "z", tolerance_deg = 0.4, calming = 0.7, gain_1_s = 0.4, timeout_s = 260 }
local kBeside_m, kBesideOnSoft_m = 0.0015, 0.0015 -- of the place before the adapter on a base that swings, and what one as soft as that adds

-- ---- places -------------------------------------------------------------------------------------------------------

-- `pose` moved in its own axes.
local function moved(pose, way_m) return geometry.compose(pose, { way_m[1], way_m[2], way_m[3], 1, 0, 0, 0 }) end

-- Where the scene's drawing has a part.
local function drawn(arm, name)
  local part = arm.part_of_scene(name)
  local p, q = part.position_m, part.quaternion_wxyz
  return { p[1], p[2], p[3], q[1], q[2], q[3], q[4] }
end

-- `fields` of a request, with the periods of the swings beside them.
local function with(swings, fields)
  for field, value in pairs(swings) do fields[field] = value end
  return fields
end

-- How soft the locked joints are beside those that the numbers are true with; an arm that stands firm has none.
local function softness(arm)
  local base = arm.robot.base
  return base and kGivesWay_Nm_per_rad / base.robot.joints[1].stiffness_Nm_per_rad or 0
end

local function swings_with(arm, mass_kg)
  local function period_s(alone_s, s2_per_kg) return math.sqrt((alone_s ^ 2 + s2_per_kg * mass_kg) * softness(arm)) end
  return { sway_s = period_s(kAlone_s, kSlowest_s2_per_kg), quicker_sway_s = period_s(kAloneQuicker_s, kQuickest_s2_per_kg) }
end

local function alone(arm) return swings_with(arm, 0) end

local function loaded(arm)
  local swings = swings_with(arm, arm.part_of_scene("payload").mass_kg)
  swings.sway_s = swings.sway_s * kHeavier
  swings.sway_tolerance = 0.2 -- payloads are up to twice as heavy as drawn, or lighter
  return swings
end

-- The tip from where it is commanded to be, along its own z; with the payload in hand.
local function along_z(way_m)
  return function(arm) arm.move_cp(with(loaded(arm), { goal = moved(arm.state.setpoint_cp, { 0, 0, way_m }) })) end
end

-- Joints as at `install`, the first one turned: nothing is in the way there.
local function near_install(turned_deg, swings)
  return function(arm)
    local goal_deg = { table.unpack(arm.named_pose "install") }
    goal_deg[1] = goal_deg[1] + turned_deg
    arm.move_jp(with(swings(arm), { goal_deg = goal_deg }))
  end
end

local function near(turned_deg)
  return condition("joints at their goal", function(arm)
    return math.abs(arm.state.setpoint_js_deg[1] - arm.named_pose("install")[1] - turned_deg) < 0.01
  end)
end

-- The grapple as the camera saw it when the end effector closed, in the tip's frame: so the payload is held. Unseen: as drawn.
local held = { 0, 0, 0, 1, 0, 0, 0 }

local function remember_grapple(arm)
  local servo = arm.state.servo
  local turn_deg = geometry.length(servo.error_deg)
  local half, axis = math.rad(turn_deg / 2), turn_deg > 0 and geometry.scale(servo.error_deg, 1 / turn_deg) or { 1, 0, 0 }
  local left = geometry.scale(axis, -math.sin(half))
  local e = servo.error_m
  local tip_in_grapple = geometry.compose({ -e[1], -e[2], -e[3] - kAtGrapple_m, 1, 0, 0, 0 }, { 0, 0, 0, math.cos(half), left[1], left[2], left[3] })
  held = geometry.inverse(tip_in_grapple)
end

-- What moving the payload takes is the drives' to know from the moment that it hangs on the arm, by its drawn mass.
local function carry_payload(arm)
  local payload = arm.part_of_scene("payload")
  local c = payload.center_m
  local center = moved(held, c)
  arm.payload { mass_kg = payload.mass_kg, center_m = { center[1], center[2], center[3] }, inertia_kgm2 = payload.inertia_kgm2 }
end

-- The middle of the pins' tips, in the tip's frame.
local function pins(arm) return moved(held, { 0, 0, arm.part_of_scene("payload").length_m }) end

-- Of the tip from the adapter's face, with the payload in hand.
local function at_adapter_m(arm) return -arm.part_of_scene("payload").length_m - kBeforeAdapter_m end

local function before_mechanism(arm)
  arm.move_cp(with(alone(arm), { goal = moved(drawn(arm, "payload"), { 0, 0, -kBeforeMechanism_m }) }))
end

local function before_site(arm)
  local way_m = { kBeforeSite_m[1], kBeforeSite_m[2], at_adapter_m(arm) + kBeforeSite_m[3] }
  arm.move_cp(with(loaded(arm), { goal = moved(drawn(arm, "adapter"), way_m) }))
end

-- The tip, or `point` of what it holds, to a place before a target along its axis.
local function servo_to(target, before_m, how, swings, point)
  return function(arm)
    local place = { target = target, offset = { 0, 0, -before_m, 1, 0, 0, 0 }, point = point and point(arm) }
    local fields = with(swings(arm), with(how, place))
    if fields.sway_s > 0 then fields.tolerance_m = fields.tolerance_m or kBeside_m + kBesideOnSoft_m * softness(arm) end
    fields.sway_tolerance = 0.1 -- it is quicker so, and calms what is left
    arm.servo_target(fields)
  end
end

local has_pushed, is_gentle = false, false

-- Before the first push either a servo has aligned it or, where none was needed, the scene.
local function may_meet_walls(arm)
  return has_pushed or (arm.part_of_scene("payload").start_lateral_m or 0) > kAligned_m
end

-- No tare: on a base that swings, what the payload's mass gives on the sensor is far more than the sensor's bias.
local function push_in(arm)
  is_gentle, has_pushed = may_meet_walls(arm), true
  arm.insert {
    force_N = kForce_N, tare = false, travel_m = kMostTravel_m, lateral_m = kMostAside_m, gains = is_gentle and kGently or nil,
  }
end

-- ---- what the states say --------------------------------------------------------------------------------------------

local begins_on_arm = condition("payload on the arm already", function(arm) return arm.part_of_scene("payload").start == "arm" end)
begins_on_arm.parts = { { name = "payload" } } -- a scene without one is refused before the start

-- The mechanism hands the payload over where it is installed, or nothing carries the arm.
local is_at_site = condition("at the site already", function(arm)
  return not (arm.robot.base and arm.part_of_scene("payload").fetch_pose)
end)

local tool_failed = { text = "the tool has failed", met = function(arm)
  local tool = arm.state.tool
  if tool.phase == "failed" then return true, ("%s: %s"):format(tool.command, tool.reason) end
  return false
end }

local function push_ended(how)
  return condition("push ended: " .. how, function(arm) return arm.state.insert["end"] == how end)
end

local captured = all { push_ended "captured", condition("adapter says captured", function(arm) return arm.state.adapter.captured end) }

local kFailures = { travel = true, aside = true, early_capture = true, adapter_silent = true, stopped = true }
local push_failed = { text = "push ended without a capture", met = function(arm)
  local ending = arm.state.insert["end"]
  if kFailures[ending] then return true, "push ended: " .. ending end
  return false
end }

local function pins_are_in(arm) return math.min(table.unpack(arm.state.adapter.depth_m)) > kIn_m end

local is_jammed = { text = "jammed", met = function(arm)
  local limit_s = is_gentle and kGentleLimit_s or kPushLimit_s
  if pins_are_in(arm) then limit_s = limit_s + kAlmostIn_s end
  if arm.elapsed_s(arm.begin_tick) <= limit_s then return false end
  return true, ("jammed: no capture within %g s"):format(limit_s)
end }

local light = condition(("less than %g N on the adapter"):format(kLight_N), function(arm)
  return geometry.length(arm.state.insert.applied_force.force_N) < kLight_N
end)

local function latch_is(state)
  return condition("latch " .. state, function(arm) return arm.state.adapter.latch == state end)
end

local capture_is_a_lie = condition("captured is told, and a pin is not in", function(arm)
  return arm.state.adapter.captured and not pins_are_in(arm)
end)

local capture_lost = condition("capture lost", function(arm) return not arm.state.adapter.captured end)

local adapter_heard = condition("adapter is heard", function(arm)
  local age_s = arm.state.adapter.age_s
  return age_s ~= nil and age_s < kHeard_s
end)

local function lock_is(state)
  return condition("lock " .. state, function(arm) return arm.state.adapter.lock == state end)
end

-- ---- steps ----------------------------------------------------------------------------------------------------------

-- A step in which the station does something.
local function of_station(name, next)
  return {
    device = "none", run = station.command(name), exit = station.done(name), time_limit_s = 60, on_fail = "hold", next = next,
  }
end

return liana.mission "payload_install" {
  robot = "macro_micro",
  scene = "payload_adapter",
  bus = "embedded_payload",

  -- 1 Preparation
  step "1 power on" (of_station "power on"),
  step "1 arms tested" (of_station "test arms"),
  step "1 pressure equal" (of_station "equalise pressure"),

  -- 2 Payload out of the airlock
  step "2 hatch open" (of_station "open hatch"),
  step "2 transfer mechanism out" (of_station("mechanism out", {
    { step = "3 mutual mode", when = begins_on_arm },
  })),

  -- 3 Operations of the arms
  step "3 near the transfer mechanism" {
    device = "none",
    enter = at_rest(),
    run = near_install(kNearPick_deg, alone),
    exit = all { near(kNearPick_deg), at_rest() },
    time_limit_s = 300,
    on_fail = "hold",
  },
  step "3 before the transfer mechanism" {
    device = "none",
    enter = at_rest(),
    run = before_mechanism,
    exit = at_rest(),
    time_limit_s = 200,
    on_fail = "hold",
  },
  step "3 servo to the payload" {
    device = "none",
    run = servo_to("grapple", kAtGrapple_m, kServoToPayload, alone),
    exit = all { servo_done(), at_rest() },
    fail_when = servo_failed(),
    time_limit_s = 210,
    on_fail = "hold",
    next = { { step = "3 before the transfer mechanism", on = "failure", at_most = kTries } },
  },
  step "3 grapple" {
    device = "none",
    run = function(arm)
      remember_grapple(arm)
      arm.tool { command = "grapple" }
    end,
    exit = liana.tool_done(),
    fail_when = tool_failed,
    time_limit_s = 30,
    on_fail = "hold",
    next = { { step = "3 before the transfer mechanism", on = "failure", at_most = kTries } },
  },
  step "3 clamps open" (of_station "open clamps"),
  step "3 retreat" {
    device = "none",
    enter = at_rest(),
    run = function(arm)
      carry_payload(arm)
      along_z(-kRetreat_m)(arm)
    end,
    exit = at_rest(),
    time_limit_s = 200,
    on_fail = "hold",
    next = { { step = "3 to the site", when = is_at_site }, { step = "3 carried to the site" } },
  },
  -- The large arm brings all of it to the site, its seven joints together, and locks them; the small one rests. It has a controller of its own.
  step "3 carried to the site" {
    device = "none",
    enter = at_rest(),
    run = liana.tool "carry",
    exit = all { liana.tool_done(), at_rest() },
    fail_when = tool_failed,
    time_limit_s = kCarryLimit_s,
    on_fail = "hold",
    next = { { step = "3 carried to the site", on = "failure", at_most = kTries }, { step = "3 to the site" } },
  },
  step "3 to the site" {
    device = "none",
    enter = at_rest(),
    run = near_install(kNearSite_deg, loaded),
    exit = all { near(kNearSite_deg), at_rest() },
    time_limit_s = 300,
    on_fail = "hold",
  },
  step "3 before the adapter" {
    device = "none",
    enter = at_rest(),
    run = before_site,
    exit = at_rest(),
    time_limit_s = 200,
    on_fail = "hold",
  },
  step "3 servo to the adapter" {
    device = "none",
    enter = at_rest(),
    run = servo_to("adapter", kBeforeAdapter_m, kServoToAdapter, loaded, pins),
    exit = all { servo_done(), at_rest() },
    fail_when = servo_failed(), -- target lost, base moving, not there in time
    time_limit_s = 270,
    on_fail = "hold",
    next = { { step = "3 away from the adapter", on = "failure", at_most = kTries }, { step = "3 mutual mode" } },
  },
  step "3 away from the adapter" {
    device = "none",
    run = along_z(-kBackOff_m),
    exit = at_rest(),
    fail_when = latch_is "closed", -- late, before the pins were out: it is not pulled at, and the ground decides
    time_limit_s = 200,
    on_fail = "hold",
    next = { step = "3 servo to the adapter", at_most = 3 * kTries + 1 },
  },
  step "3 mutual mode" {
    device = "none",
    run = function(arm)
      if begins_on_arm.met(arm) then carry_payload(arm) end
      arm.hold()
    end,
    exit = all { at_rest(), adapter_heard },
    time_limit_s = 30,
    on_fail = "hold",
  },
  step "3 push" {
    device = "none",
    run = push_in,
    exit = captured,
    fail_when = any { push_failed, is_jammed },
    time_limit_s = kGentleLimit_s + kAlmostIn_s + 5,
    on_fail = "hold",
    next = { { step = "3 away from the adapter", when = latch_is "open", on = "failure", at_most = kTries } }, -- not against a latch
  },
  step "3 unloaded" {
    device = "none",
    exit = all { captured, latch_is "closed", light },
    fail_when = any { capture_is_a_lie, latch_is "failed" },
    time_limit_s = 30,
    on_fail = "hold",
    next = { { step = "3 away from the adapter", when = latch_is "open", on = "failure", at_most = kTries } },
  },
  step "3 ground confirms the unloading" {
    device = "none",
    exit = station.ground_confirms("unloading", all { captured, light }),
    fail_when = capture_lost,
    time_limit_s = 3600,
    on_fail = "hold",
  },
  step "3 out of the push" { -- giving way is from rest
    device = "none",
    run = function(arm) arm.hold() end,
    exit = at_rest(),
    time_limit_s = 30,
    on_fail = "hold",
  },
  step "3 lock" {
    device = "none",
    run = function(arm)
      arm.comply()
      arm.adapter { command = "lock" }
    end,
    exit = lock_is "closed",
    fail_when = any { lock_is "failed", capture_lost },
    time_limit_s = kLockLimit_s,
    on_fail = "hold",
    next = { { step = "3 lock", on = "failure", at_most = kTries } },
  },
  step "3 out of the mode" {
    device = "none",
    run = function(arm) arm.hold() end,
    exit = at_rest(),
    time_limit_s = 30,
    on_fail = "hold",
  },

  -- 4 Self-test of the payload, restoring
  step "4 payload tested" (of_station "test payload"),
  step "4 transfer mechanism in" (of_station "mechanism in"),
  step "4 hatch closed" (of_station "close hatch"),
  step "4 power off" (of_station "power off"),
}
