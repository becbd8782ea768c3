#include "host/model/simulation/serial_chain.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

namespace liana::simulation {

namespace {

using Eigen::Vector3d;
using serial::JointVector;

Vec3 vec3(const Vector3d& v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

SerialAxis serial_axis(const serial::RobotParams& table, const serial::JointVector& joint_rad) {
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
  for (Eigen::Index k = 0; k < 3; ++k) axis.tip_axis[static_cast<std::size_t>(k)] = vec3(frame.linear().col(k));
  return axis;
}

double axis_length_m(const serial::RobotParams& table) {
  double sum_m = 0.0;
  for (std::size_t i = 0; i < table.joints(); ++i)
    sum_m += std::fabs(table.joint[i].dh.d_m) + std::fabs(table.joint[i].dh.a_m);
  return sum_m;
}

namespace {

// How many places of the way from a fetch pose are looked at besides its ends; the arm on top rests meanwhile.
constexpr int kBetween = 3;

// Where the arm below is, one place after the other; where it is locked first.
std::vector<JointVector> places_of(const config::SerialRobotConfig& robot, const config::SceneConfig& scene) {
  const config::LockedBase& base = *robot.base;
  std::vector<JointVector> places{base.joint_rad};
  if (!config::is_carried(robot, scene)) return places;
  if (const std::string why = config::why_not_carried(robot, scene); !why.empty())
    throw std::runtime_error("scene " + scene.name + ": " + why);
  const JointVector& from_rad = base.named_poses_rad.at(scene.payload->fetch_pose);
  for (int i = 0; i <= kBetween; ++i) {
    places.push_back(from_rad);
    for (std::size_t k = 0; k < base.table.joints(); ++k)
      places.back()[k] += (base.joint_rad[k] - from_rad[k]) * i / (kBetween + 1);
  }
  return places;
}

void add_links(const config::LockedBase& base, const JointVector& joint_rad, SerialModel& model) {
  const SerialAxis axis = serial_axis(base.table, joint_rad);
  const auto here = [&](std::size_t i) {
    const Vec3 from_tip = subtract(axis.point_m[i], axis.tip_m());
    return Vec3{dot(axis.tip_axis[0], from_tip), dot(axis.tip_axis[1], from_tip), dot(axis.tip_axis[2], from_tip)};
  };
  for (std::size_t i = 0; i + 1 < axis.count; ++i) model.base.push_back({here(i), here(i + 1), base.link_radius_m});
}

}  // namespace

// The frame that the base of this arm is in is that at the tip of the other one.
SerialModel serial_model(const config::SerialRobotConfig& robot, const config::SceneConfig& scene) {
  SerialModel model{robot.table, robot.link_radius_m, {}, {}, {}};
  if (!robot.base) return model;
  model.base_name = robot.base->name;
  for (const JointVector& joint_rad : places_of(robot, scene)) add_links(*robot.base, joint_rad, model);
  for (std::size_t i = 0; i < kPiecesPerLink * robot.base->table.joints(); ++i)
    model.base_of_link.push_back(static_cast<std::int32_t>(i) / kPiecesPerLink);
  return model;
}

CarriedBody carried_body(const config::ScenePayload& payload) {
  const double end_m = std::fmin(payload.radius_m, 0.5 * payload.length_m);
  return {end_m, payload.length_m - end_m, payload.radius_m};
}

}  // namespace liana::simulation
