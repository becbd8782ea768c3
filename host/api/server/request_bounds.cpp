#include "host/api/server/request_bounds.hpp"

#include <algorithm>
#include <cmath>

#include "host/base/json/json.hpp"

namespace liana::api {

namespace {

// Slide and roll of a base that feeds, then two angles a segment, pitch then yaw, in one range.
void add_segments(const Json& robot, RequestBounds& out) {
  if (robot.contains("base")) {
    const Json& base = robot.at("base");
    const double limit_deg = base.at("limit_deg").get<double>();
    out.angle_deg.insert(out.angle_deg.end(), 2, {-limit_deg, limit_deg});
    out.reach_m += limit_deg * base.at("slide_m_per_deg").get<double>();
  }
  for (const Json& segment : robot.at("segments")) {
    const double limit_deg = segment.at("theta_limit_deg").get<double>();
    out.angle_deg.insert(out.angle_deg.end(), 2, {-limit_deg, limit_deg});
    out.reach_m += segment.at("modules").get<double>() * segment.at("module_length_m").get<double>();
  }
  out.nodes = static_cast<std::int32_t>(out.angle_deg.size()) / 2 - 1;
}

void add_joints(const Json& joints, RequestBounds& out) {
  for (const Json& joint : joints) {
    out.angle_deg.push_back({joint.at("low_deg").get<double>(), joint.at("high_deg").get<double>()});
    out.angle_rate_deg_s = std::max(out.angle_rate_deg_s, joint.at("rate_deg_s").get<double>());
    out.reach_m += std::hypot(joint.at("a_m").get<double>(), joint.at("d_m").get<double>());
  }
}

}  // namespace

double RequestBounds::value_of(const Bound& bound) const {
  switch (bound.figure) {
    case Figure::kReach:
      return bound.factor * reach_m;
    case Figure::kAngles:
      return bound.factor * static_cast<double>(angle_deg.size());
    case Figure::kAngleRate:
      return bound.factor * angle_rate_deg_s;
    case Figure::kTipSpeed:
      return bound.factor * tip_speed_m_s;
    case Figure::kNodes:
      return bound.factor * nodes;
    case Figure::kOne:
      break;
  }
  return bound.factor;
}

RequestBounds request_bounds(const Json& robot) {
  RequestBounds out;
  const Json& limits = robot.at("limits");
  out.arm = robot.value("kind", "") == "serial" ? kSerialArm : kCableArm;
  out.robot = robot.value("name", "");
  out.tip_speed_m_s = limits.at("tip_speed_m_s").get<double>();
  out.tip_rate_deg_s = limits.at("tip_rate_deg_s").get<double>();
  if (out.arm == kSerialArm) {
    add_joints(robot.at("joints"), out);
  } else {
    add_segments(robot, out);
    out.angle_rate_deg_s = limits.at("theta_rate_deg_s").get<double>();
  }
  return out;
}

}  // namespace liana::api
