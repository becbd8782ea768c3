// lab_1g as these tests measure it.
#pragma once

#include "host/base/json/json.hpp"
#include "host/model/config/bench_buses.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::calibration {

// Its table, with springs in its joints where they have a stiffness.
inline config::RobotConfig lab_1g(double stiffness_Nm_per_rad = 0.0) {
  Json table = config::good_table("robot", "lab_1g");
  if (stiffness_Nm_per_rad > 0.0) table["joint"]["stiffness_Nm_per_rad"] = stiffness_Nm_per_rad;
  return config::parse_robot(table.dump(), "r", "nominal", config::parse_buses(config::bench_buses(15), "b"));
}

}  // namespace liana::calibration
