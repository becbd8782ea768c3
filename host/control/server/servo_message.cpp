#include "host/control/server/servo_message.hpp"

#include "firmware_like/math/trig.hpp"
#include "host/base/json/json.hpp"
#include "host/control/server/state_parts.hpp"

namespace liana::server {

visual_servo::ServoRequest servo_request(const api::Arguments& fields) {
  visual_servo::ServoRequest out;
  out.target = fields.text("target");
  out.place = fields.pose("offset");
  if (fields.has("point")) out.point_in_tip = fields.pose("point");
  out.tolerance_m = fields.number("tolerance_m");
  out.tolerance_rad = fields.number("tolerance_deg") * kDegree;
  out.dwell_s = fields.number("dwell_s");
  out.timeout_s = fields.number("timeout_s");
  out.lost_s = fields.number("lost_s");
  out.tau_s = fields.number("tau_s");
  out.swings = swings_of(fields);
  out.calming = fields.number("calming");
  out.limits = {fields.number("gain_1_s"),
                fields.number("speed_m_s"),
                fields.number("lateral_speed_m_s"),
                fields.number("rate_deg_s") * kDegree,
                fields.number("accel_m_s2"),
                fields.number("accel_deg_s2") * kDegree,
                fields.has("axis") ? static_cast<std::size_t>(fields.text("axis").front() - 'x') : 0};
  return out;
}

motion::Swings swings_of(const api::Arguments& fields) {
  return {fields.number("sway_s"), fields.number("quicker_sway_s"), fields.number("sway_tolerance")};
}

Json servo_json(const visual_servo::ServoStatus& report) {
  Json out{{"phase", visual_servo::servo_phase_name(report.phase)},
           {"target", report.target},
           {"place", report.place ? pose_json(*report.place) : Json()},
           {"error_m", nullptr},
           {"error_deg", nullptr},
           {"sway_m", report.swing_m},
           {"observations_used", report.images_used},
           {"observations_rejected", report.images_rejected},
           {"duration_s", report.duration_s},
           {"reason", report.reason}};
  if (!report.error) return out;
  const Vec3& rad = report.error->rad;
  out["error_m"] = report.error->m;
  out["error_deg"] = {in_degrees(rad[0]), in_degrees(rad[1]), in_degrees(rad[2])};
  return out;
}

}  // namespace liana::server
