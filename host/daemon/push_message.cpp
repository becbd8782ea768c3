#include "host/daemon/push_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "firmware_like/math/trig.hpp"
#include "host/api/request_error.hpp"
#include "host/config/serial_torque.hpp"

namespace liana::daemon {

namespace {

constexpr std::array kPhases{"none", "taring", "relieving", "pressing", "unloading", "yielding"};
constexpr std::array kEnds{"none",  "captured",      "sensor_lost",    "overload", "travel",
                           "aside", "early_capture", "adapter_silent", "stopped"};
constexpr std::array kHealth{"good", "silent", "saturated", "failed", "no_number", "not_at_rest"};
constexpr std::array kCatches{"open", "closing", "closed", "failed"};
static_assert(kPhases.size() == static_cast<std::size_t>(serial::PushPhase::kYielding) + 1);
static_assert(kEnds.size() == static_cast<std::size_t>(serial::PushEnd::kStopped) + 1);
static_assert(kHealth.size() == static_cast<std::size_t>(serial::WristHealth::kNotAtRest) + 1);
static_assert(kCatches.size() == static_cast<std::size_t>(serial::CatchState::kFailed) + 1);

template <class Names, class Value>
const char* name_of(const Names& names, Value value) {
  return names.at(static_cast<std::size_t>(value));
}

void require(const char* field, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw api::RequestError("out_of_range", std::string(field) + ": " + Json(value).dump() + ": allowed is " +
                                              Json(low).dump() + " to " + Json(high).dump() +
                                              ", as force_control of the robot says");
}

Vec3 axis_of(const api::Arguments& fields) {
  if (!fields.has("axis")) return {0.0, 0.0, 1.0};
  const Vec3 axis = fields.point("axis");
  const double length = norm(axis);
  if (length < 1e-3)
    throw api::RequestError("out_of_range", "axis: it has no length: give the direction of the way in");
  return scale(axis, 1.0 / length);
}

serial::PushGains gains_of(const config::SerialRobotConfig& robot, const api::Arguments& fields) {
  serial::PushGains gains = robot.push_gains;
  if (!fields.has("gains")) return gains;
  const api::Arguments asked = fields.object("gains");
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const char* const name = config::kPushGainNames[i];
    if (!asked.has(name)) continue;
    gains[i] = asked.number(name);
    require(name, gains[i], robot.table.torque.gain_low[i], robot.table.torque.gain_high[i]);
  }
  return gains;
}

Json wrench_json(const serial::Wrench& wrench) {
  return {{"force_N", wrench.force_N}, {"torque_Nm", wrench.torque_Nm}};
}

// Seconds; null: never heard.
Json age_json(std::uint16_t age_ticks, double tick_s) {
  return age_ticks == serial::kNeverHeard ? Json() : Json(age_ticks * tick_s);
}

}  // namespace

serial::Push push_of(const config::SerialRobotConfig& robot, const api::Arguments& fields) {
  const serial::TorqueTable& most = robot.table.torque;
  serial::Push push;
  push.law =
      fields.has("law") && fields.text("law") == "impedance" ? serial::PushLaw::kImpedance : serial::PushLaw::kForce;
  push.tares = fields.flag("tare") ? 1 : 0;
  push.axis_in_tip = axis_of(fields);
  push.force_N = fields.number("force_N");
  push.travel_m = fields.number("travel_m");
  push.aside_m = fields.number("aside_m");
  push.turn_rad = fields.number("turn_deg") * kDegree;
  push.depth_m = fields.number("depth_m");
  if (push.law == serial::PushLaw::kForce) push.depth_m = 0.0;
  push.gains = gains_of(robot, fields);
  if (most.gives_torque == 0) return push;  // the arbiter says why there is none
  if (!robot.has_wrist_sensor)
    throw api::RequestError(
        "refused",
        "the bus table has no wrist_sensor, which a push needs: give its node at the bus that it is "
        "on, as embedded_payload does");
  require("force_N", push.force_N, 0.0, most.most_force_N);
  require("travel_m", push.travel_m, 0.0, most.most_travel_m);
  require("aside_m", push.aside_m, 0.0, most.most_aside_m);
  require("turn_deg", fields.number("turn_deg"), 0.0, most.most_turn_rad / kDegree);
  require("depth_m", push.depth_m, 0.0, push.travel_m);
  push.turn_rad = std::fmin(push.turn_rad, most.most_turn_rad);
  return push;
}

serial::LinkMass payload_of(const api::Arguments& fields) {
  serial::LinkMass payload;
  payload.mass_kg = fields.number("mass_kg");
  if (payload.mass_kg == 0.0) return payload;
  if (fields.has("center_m")) payload.center_m = fields.point("center_m");
  const auto inertia = fields.has("inertia_kgm2") ? fields.numbers("inertia_kgm2") : std::vector<double>{};
  if (inertia.size() != payload.inertia_kgm2.size())
    throw api::RequestError("out_of_range", "inertia_kgm2: " + std::to_string(inertia.size()) +
                                                " numbers: give six, xx, yy, zz, xy, xz, yz about the centre of mass");
  std::copy(inertia.begin(), inertia.end(), payload.inertia_kgm2.begin());
  if (!serial::is_body(payload))
    throw api::RequestError("out_of_range", "inertia_kgm2: " + Json(inertia).dump() +
                                                ": no body has it: moments are over 0, none is larger than the other "
                                                "two together: compute it from the body, about its centre of mass");
  return payload;
}

Json payload_json(const serial::LinkMass& payload_at_tip) {
  return {{"mass_kg", payload_at_tip.mass_kg}, {"center_m", payload_at_tip.center_m}};
}

Json push_json(const serial::PushReport& push, double tick_s) {
  const bool was_asked = push.number > 0;
  const auto of_push = [&](Json value) { return was_asked ? std::move(value) : Json(); };
  const bool is_heard = push.wrist_age_ticks != serial::kNeverHeard;
  return {{"number", push.number},
          {"phase", name_of(kPhases, push.phase)},
          {"end", name_of(kEnds, push.end)},
          {"law", push.law == serial::PushLaw::kImpedance ? "impedance" : "force"},
          {"set_N", of_push(push.set_N)},
          {"given", of_push(wrench_json(push.given))},
          {"felt", is_heard ? wrench_json(push.felt) : Json()},
          {"touched", push.touched != 0},
          {"travel_m", of_push(push.travel_m)},
          {"aside_m", of_push(push.aside_m)},
          {"wrist", name_of(kHealth, push.wrist)},
          {"wrist_age_s", age_json(push.wrist_age_ticks, tick_s)}};
}

Json adapter_json(const serial::PushReport& push, double tick_s) {
  Json depth_m;
  if (push.adapter_age_ticks != serial::kNeverHeard) {
    depth_m = Json::array();
    for (const std::uint8_t depth : push.depth_01mm) depth_m.push_back(1e-4 * depth);
  }
  return {{"age_s", age_json(push.adapter_age_ticks, tick_s)},
          {"sequence", push.adapter_sequence},
          {"captured", push.captured != 0},
          {"latch", name_of(kCatches, push.latch)},
          {"lock", name_of(kCatches, push.lock)},
          {"depth_m", depth_m}};
}

}  // namespace liana::daemon
