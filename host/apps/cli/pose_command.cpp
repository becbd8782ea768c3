#include <cstdio>
#include <span>

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/static_load.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/pose_json.hpp"
#include "host/apps/cli/serial_commands.hpp"
#include "host/apps/cli/slit_part.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::cli {
namespace {

Json pose_of(const cable::RobotParams& table, const cable::ThetaVector& theta_rad) {
  const cable::ArmTrig trig = arm_trig(table, theta_rad);
  const cable::ArmKinematics arm = forward_kinematics(table, trig);
  const cable::CableLayout layout = cable_layout(table);
  const cable::CableGeometry cables = cable_geometry(table, layout, trig);
  Json ends = Json::array();
  for (std::size_t m = 1; m <= static_cast<std::size_t>(table.segment_count); ++m)
    ends.push_back(arm.node_in_base[m].position_m);
  const cable::ThetaVector load_Nm = static_load_Nm(table, theta_rad, trig, arm);
  const auto angles = static_cast<std::size_t>(table.theta_count());
  Json length = Json::array();
  Json change = Json::array();
  Json by_theta = Json::array();
  for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
    length.push_back(cables.length_m[c]);
    change.push_back(cables.length_m[c] - layout.zero_length_m[c]);
    by_theta.push_back(std::span(cables.jacobian_m_rad[c]).first(angles));
  }
  return {{"tip_pose", homogeneous(arm.tip_in_base)},
          {"segment_ends_m", ends},
          {"jacobian", jacobian_rows(arm.tip_jacobian.linear, arm.tip_jacobian.angular, table.theta_count())},
          {"cable_length_m", length},
          {"cable_length_change_m", change},
          {"cable_jacobian_m_rad", by_theta},
          {"static_load_Nm", std::span(load_Nm).first(angles)}};
}

void print_summary(const config::DriveNames& names, const Json& pose) {
  for (const Json& row : pose["tip_pose"]) {
    std::printf("%10.6f %10.6f %10.6f %11.6f m\n", row[0].get<double>(), row[1].get<double>(), row[2].get<double>(),
                row[3].get<double>());
  }
  const Json& change = pose["cable_length_change_m"];
  for (std::size_t c = 0; c < change.size(); ++c) {
    std::printf("%-22s: %10.6f m, %+9.3f mm\n", names.cable(c).c_str(), pose["cable_length_m"][c].get<double>(),
                1000.0 * change[c].get<double>());
  }
  if (pose.contains("slit")) std::printf("slit: %s\n", pose["slit"].dump().c_str());
}

}  // namespace

int pose_command(const PoseOptions& options) {
  if (const auto serial = launcher::serial_robot_for_kinematics(options.robot))
    return serial_pose_command(*serial, options);
  const config::RobotConfig robot = launcher::robot_for_kinematics(options.robot);
  const cable::ThetaVector theta_rad = parse_pose_deg("--theta-deg", options.theta_deg, robot);
  Json pose = pose_of(robot.table, theta_rad);
  if (!options.scene.empty()) {
    const config::SceneConfig scene = launcher::scene_of(options.scene);
    if (!scene.slit)
      throw launcher::BadInput("--scene: '" + options.scene + "': has no slit; name a scene with one, or leave it out");
    pose["slit"] = slit_part(robot, scene, theta_rad);
  }
  if (options.json) {
    std::puts(pose.dump().c_str());
  } else {
    print_summary(config::DriveNames(robot.table), pose);
  }
  return 0;
}

}  // namespace liana::cli
