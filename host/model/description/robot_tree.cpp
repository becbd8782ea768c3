#include "host/model/description/robot_tree.hpp"

#include <cmath>

namespace liana::description {

RobotTree tree_of(const std::string& robot_json, const std::string& buses_json, const std::string& file) {
  const config::BusesConfig buses = config::parse_buses(buses_json, file);
  if (config::robot_kind(robot_json, file) == "serial")
    return tree_of(config::parse_serial_robot(robot_json, file, buses));
  return tree_of(config::parse_robot(robot_json, file, "nominal", buses));
}

std::vector<double> joint_values(const RobotTree& tree, std::span<const double> theta_rad) {
  std::vector<double> values;
  for (const Link& link : tree.links) {
    const bool moves = link.joint.kind != Joint::Kind::kFixed;
    values.push_back(moves ? link.joint.per_rad * theta_rad[link.joint.theta] : 0.0);
  }
  return values;
}

Pose in_parent(const Link& link, double value) {
  Pose moved;
  if (link.joint.kind == Joint::Kind::kPrismatic) moved.position_m = scale(link.joint.axis, value);
  if (link.joint.kind == Joint::Kind::kRevolute) {
    const Vec3 turn = scale(link.joint.axis, std::sin(0.5 * value));
    moved.quaternion = {std::cos(0.5 * value), turn[0], turn[1], turn[2]};
  }
  return compose(link.origin, moved);
}

Quat quaternion_of_axes(const std::array<Vec3, 3>& axis) {
  const double trace = axis[0][0] + axis[1][1] + axis[2][2];
  std::size_t i = 0;
  if (axis[1][1] > axis[i][i]) i = 1;
  if (axis[2][2] > axis[i][i]) i = 2;
  const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
  Quat q{};
  if (trace > 0.0) {
    q = {1.0 + trace, axis[1][2] - axis[2][1], axis[2][0] - axis[0][2], axis[0][1] - axis[1][0]};
  } else {
    q[0] = axis[j][k] - axis[k][j];
    q[i + 1] = 1.0 + axis[i][i] - axis[j][j] - axis[k][k];
    q[j + 1] = axis[i][j] + axis[j][i];
    q[k + 1] = axis[i][k] + axis[k][i];
  }
  return normalize(q);
}

Quat turn_from_z(const Vec3& along) {
  const Vec3 unit = scale(along, 1.0 / norm(along));
  if (unit[2] < -0.999999) return {0.0, 1.0, 0.0, 0.0};
  return normalize({1.0 + unit[2], -unit[1], unit[0], 0.0});
}

}  // namespace liana::description
