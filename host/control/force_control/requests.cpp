#include "host/control/force_control/requests.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "firmware_like/cable/arm/setpoint.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/api/server/request_error.hpp"
#include "host/api/server/request_text.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/serial_torque.hpp"

namespace liana::force_control {

namespace {

constexpr double kMinAxis = 1e-3;  // a shorter one has no direction
constexpr const char* kByTable = ", as force_control of the robot says";

void require(const std::string& field, double value, double low, double high, const char* as_said) {
  if (value >= low && value <= high) return;
  throw api::RequestError("out_of_range", field + " = " + api::text_of(value) + ": allowed " + api::text_of(low) +
                                              " to " + api::text_of(high) + api::unit_of(field) + as_said +
                                              ": choose another value");
}

Vec3 axis_of(const api::Arguments& fields) {
  if (!fields.has("axis")) return {0.0, 0.0, 1.0};
  const Vec3 axis = fields.point("axis");
  const double length = norm(axis);
  if (length < kMinAxis) {
    throw api::RequestError("out_of_range", "axis = " + Json(axis).dump() + ": allowed a length of " +
                                                api::text_of(kMinAxis) + " or more: give the direction of the way in");
  }
  return scale(axis, 1.0 / length);
}

serial::InsertGains gains_of(const config::SerialRobotConfig& robot, const api::Arguments& fields) {
  serial::InsertGains gains = robot.push_gains;
  if (!fields.has("gains")) return gains;
  const api::Arguments asked = fields.object("gains");
  for (std::size_t i = 0; i < gains.size(); ++i) {
    const std::string name = config::kPushGainNames[i];
    if (!asked.has(name)) continue;
    gains[i] = asked.number(name);
    require("gains." + name, gains[i], robot.table.torque.gain_low[i], robot.table.torque.gain_high[i], kByTable);
  }
  return gains;
}

void require_wrist_sensor(const config::SerialRobotConfig& robot) {
  if (robot.has_wrist_sensor) return;
  throw api::RequestError("refused",
                          "the bus table has no wrist_sensor, which a push needs: give its node at the bus that it is "
                          "on, as embedded_payload does");
}

}  // namespace

serial::Push push_of(const config::SerialRobotConfig& robot, const api::Arguments& fields) {
  require_torque_drives(robot);
  require_wrist_sensor(robot);
  const serial::TorqueParams& most = robot.table.torque;
  serial::Push push;
  push.law = fields.has("law") && fields.text("law") == "impedance" ? serial::InsertLaw::kImpedance
                                                                    : serial::InsertLaw::kForce;
  push.tares = fields.flag("tare") ? 1 : 0;
  push.axis_in_tip = axis_of(fields);
  push.force_N = fields.number("force_N");
  push.travel_m = fields.number("travel_m");
  push.aside_m = fields.number("lateral_m");
  push.depth_m = fields.number("depth_m");
  if (push.law == serial::InsertLaw::kForce) push.depth_m = 0.0;
  push.gains = gains_of(robot, fields);
  require("force_N", push.force_N, 0.0, most.most_force_N, kByTable);
  require("travel_m", push.travel_m, 0.0, most.most_travel_m, kByTable);
  require("lateral_m", push.aside_m, 0.0, most.most_aside_m, kByTable);
  require("turn_deg", fields.number("turn_deg"), 0.0, most.most_turn_rad / kDegree, kByTable);
  require("depth_m", push.depth_m, 0.0, push.travel_m, ", which is travel_m");
  push.turn_rad = std::fmin(fields.number("turn_deg") * kDegree, most.most_turn_rad);
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

cable::TipLoad tip_load_of(const api::Arguments& fields) {
  if (fields.has("inertia_kgm2"))
    throw api::RequestError("bad_request",
                            "inertia_kgm2: a cable arm takes a payload as a point mass: leave inertia_kgm2 out");
  const cable::TipLoad payload{fields.number("mass_kg"), fields.has("center_m") ? fields.point("center_m") : Vec3{}};
  if (is_usable(payload)) return payload;
  char text[160];
  std::snprintf(text, sizeof text,
                "mass_kg = %.4g, center_m: a cable arm carries up to %.0f kg within %.0f m of its tip along each axis",
                payload.mass_kg, cable::kMaxTipLoad_kg, cable::kMaxTipLoad_m);
  throw api::RequestError("out_of_range", text);
}

void require_torque_drives(const config::SerialRobotConfig& robot) {
  if (config::is_torque_controlled(robot)) return;
  throw api::RequestError("refused",
                          "the drives of this robot follow positions: force control needs a robot whose "
                          "drives follow torques (drives.mode = \"torque\", as macro_micro)");
}

void require_adapter(const config::SerialRobotConfig& robot) {
  if (robot.has_adapter) return;
  throw api::RequestError("refused",
                          "the bus table has no adapter, which is told to lock and to release: give its node at the "
                          "bus that it is on, as embedded_payload does");
}

void require_possible(const config::SerialRobotConfig& robot, std::string_view op, const api::Arguments& fields) {
  if (op == "insert") push_of(robot, fields);
  if (op == "payload") payload_of(fields);
  if (op == "comply") require_torque_drives(robot);
  if (op == "adapter") require_adapter(robot);
}

}  // namespace liana::force_control
