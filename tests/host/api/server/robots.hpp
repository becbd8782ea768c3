// Bounds of two robots, one of each kind, as their tables in lua/robots state them.
#pragma once

#include "host/api/server/request_bounds.hpp"
#include "host/base/json/json.hpp"

namespace liana::api {

// What request_bounds reads of zhu2022: five segments of eight modules of 0.1 m.
inline Json zhu2022_json() {
  const Json segment{{"modules", 8}, {"module_length_m", 0.1}, {"theta_limit_deg", 20}};
  return {{"kind", "robot"},
          {"name", "zhu2022"},
          {"segments", Json::array({segment, segment, segment, segment, segment})},
          {"limits", {{"theta_rate_deg_s", 2}, {"tip_speed_m_s", 0.1}, {"tip_rate_deg_s", 20}}}};
}

// What it reads of micro: seven joints of +-270 deg.
inline Json micro_json() {
  Json joints = Json::array();
  for (const double length_m : {0.28, 0.22, 2.10, 2.10, 0.20, 0.22, 0.28})
    joints.push_back({{"a_m", length_m}, {"d_m", 0}, {"low_deg", -270}, {"high_deg", 270}, {"rate_deg_s", 4}});
  return {{"kind", "serial"},
          {"name", "micro"},
          {"joints", joints},
          {"limits", {{"tip_speed_m_s", 0.1}, {"tip_rate_deg_s", 3}}}};
}

}  // namespace liana::api
