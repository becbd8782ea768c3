#include "host/simulate/serial_chain.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace liana::simulate {

namespace {

using Eigen::Vector3d;

Vec3 vec3(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

SerialAxis serial_axis(const serial::RobotTable& table, const serial::JointVector& joint_rad) {
  SerialAxis axis;
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  axis.point_m[axis.count++] = vec3(frame.translation());
  for (std::size_t i = 0; i < table.joints(); ++i) {
    const serial::DhRow& row = table.joint[i].dh;
    frame.rotate(Eigen::AngleAxisd(joint_rad[i] + row.offset_rad, Vector3d::UnitZ()));
    frame.translate(Vector3d(0.0, 0.0, row.d_m));
    axis.point_m[axis.count++] = vec3(frame.translation());
    frame.translate(Vector3d(row.a_m, 0.0, 0.0));
    axis.point_m[axis.count++] = vec3(frame.translation());
    frame.rotate(Eigen::AngleAxisd(row.alpha_rad, Vector3d::UnitX()));
  }
  axis.tip_z = vec3(frame.linear().col(2));
  return axis;
}

double axis_length_m(const serial::RobotTable& table) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < table.joints(); ++i)
    sum_m += std::fabs(table.joint[i].dh.d_m) + std::fabs(table.joint[i].dh.a_m);
  return sum_m;
}

// The frame that the base of this arm is in is that at the tip of the other one.
SerialModel serial_model(const config::SerialRobotConfig& robot) {
  SerialModel model{robot.table, robot.link_radius_m, {}, {}, {}};
  if (!robot.base) return model;
  const config::LockedBase& base = *robot.base;
  model.base_name = base.name;
  const SerialAxis axis = serial_axis(base.table, base.joint_rad);
  const Pose root_in_base = inverse(base.base_in_root);
  const auto here = [&](std::size_t i) {
    return add(rotate(root_in_base.quaternion, axis.point_m[i]), root_in_base.position_m);
  };
  for (std::size_t i = 0; i + 1 < axis.count; ++i) {
    model.base.push_back({here(i), here(i + 1), base.link_radius_m});
    model.base_of_link.push_back(static_cast<std::int32_t>(i) / kPiecesPerLink);
  }
  return model;
}

CarriedBody carried_body(const config::ScenePayload& payload) {
  const double end_m = std::fmin(payload.radius_m, 0.5 * payload.length_m);
  return {end_m, payload.length_m - end_m, payload.radius_m};
}

}  // namespace liana::simulate
