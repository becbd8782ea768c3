#include "host/apps/cli/slit_part.hpp"

#include "firmware_like/math/trig.hpp"
#include "host/model/config/slit_mouth.hpp"
#include "host/model/config/theta_numbers.hpp"

namespace liana::cli {
namespace {

Json range_deg(const inverse_kinematics::YawInterval& interval) {
  if (interval.empty) return nullptr;
  return {interval.lowest_rad / kDegree, interval.highest_rad / kDegree};
}

}  // namespace

Json slit_part(const config::RobotConfig& robot, const config::SceneConfig& scene,
               const cable::ThetaVector& theta_rad) {
  const cable::RobotParams& table = robot.table;
  const inverse_kinematics::SlitMouth mouth = config::slit_mouth(*scene.slit, robot.module_radius_m);
  const std::int32_t segments = inverse_kinematics::planar_segments(table, link_points(table, theta_rad), mouth,
                                                                    inverse_kinematics::PlanarSwitch{}, 0);
  const inverse_kinematics::PlanarPart part{segments, forward_kinematics(table, theta_rad).tip_in_base, theta_rad};
  Json out{{"planar_segments", segments},
           {"held_theta", config::theta_numbers(inverse_kinematics::planar_pitches(table, segments))},
           {"root", nullptr},
           {"yaw_range_deg", Json::array()}};
  if (segments == 0) return out;
  const Pose root = inverse_kinematics::root_of(table, part);
  const Vec3& p = root.position_m;
  const Quat& q = root.quaternion;
  out["root"] = {p[0], p[1], p[2], q[0], q[1], q[2], q[3]};
  for (std::int32_t m = table.segment_count - segments + 1; m <= table.segment_count; ++m) {
    out["yaw_range_deg"].push_back(range_deg(inverse_kinematics::feasible_yaw(table, part, mouth, m)));
  }
  return out;
}

}  // namespace liana::cli
