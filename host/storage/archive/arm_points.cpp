#include "host/storage/archive/arm_points.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/math/trig.hpp"
#include "host/api/telemetry/record.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::archive {
namespace {

constexpr const char* kSource = "life of the archive";

}  // namespace

ArmPoints::ArmPoints(const Life& life, const telemetry::Layout& layout) : layout_(layout) {
  if (config::robot_kind(life.robot, kSource) == "serial") return;
  const config::RobotConfig robot =
      config::parse_robot(life.robot, kSource, "nominal", config::parse_buses(life.buses, kSource));
  table_ = robot.table;
  radius_m_ = robot.module_radius_m;
}

const telemetry::Place* ArmPoints::place(const char* field) const {
  for (const telemetry::Place& each : layout_.places) {
    if (each.field.path == field) return &each;
  }
  return nullptr;
}

std::vector<Vec3> ArmPoints::of(const std::string& record) const {
  const bool is_serial = table_.segment_count == 0;
  const telemetry::Place* values = place(is_serial ? "node_m" : "measured_js_deg");
  if (values == nullptr || !std::isfinite(telemetry::value_of(record, *values, 0))) return {};
  std::vector<double> numbers;
  for (std::size_t i = 0; i < values->count; ++i)
    numbers.push_back(static_cast<double>(telemetry::value_of(record, *values, i)));
  if (!is_serial) {
    cable::ThetaVector theta_rad{};
    for (std::size_t i = 0; i < std::min(numbers.size(), theta_rad.size()); ++i) theta_rad[i] = numbers[i] * kDegree;
    const cable::LinkPoints points = cable::link_points(table_, theta_rad);
    return {points.axis().begin(), points.axis().end()};
  }
  std::vector<Vec3> points{Vec3{}};
  for (std::size_t i = 0; i + 2 < numbers.size(); i += 3)
    points.push_back({numbers[i], numbers[i + 1], numbers[i + 2]});
  return points;
}

}  // namespace liana::archive
