#include "host/apps/cli/serial_robot_check.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "firmware_like/math/trig.hpp"
#include "host/apps/launcher/start_pose.hpp"
#include "host/model/simulation/serial_contact.hpp"
#include "host/planning/self_motion/swings.hpp"

namespace liana::cli {
namespace {

// The two longest periods with which an arm on another one, which is locked, swings: what moves is to leave the base
// still.
Json swings_of(const config::SerialRobotConfig& robot, const serial::JointVector& joint_rad,
               const serial::LinkMass& load) {
  serial::JointVector stiffness_Nm_rad{};
  std::copy(robot.stiffness_Nm_rad.begin(), robot.stiffness_Nm_rad.end(), stiffness_Nm_rad.begin());
  const config::LockedBase& base = *robot.base;
  const std::array<self_motion::SpringyArm, 2> chain = {{
      {base.table, base.masses, base.joint_rad, base.stiffness_Nm_rad},
      {robot.table, robot.masses, joint_rad, stiffness_Nm_rad},
  }};
  const std::vector<double> periods_s = self_motion::swing_periods_s(chain, load);
  return {periods_s[0], periods_s[1]};
}

serial::LinkMass body_of(const config::ScenePayload& payload) {
  return {payload.mass_kg, payload.center_m, payload.inertia_kgm2};
}

// By named pose; with the payload of the scene as it hangs on the tip, where there is one. Empty: nothing can be told.
Json swings_at_poses(const config::SerialRobotConfig& robot, const config::SceneConfig& scene) {
  Json out = Json::object();
  if (!robot.base || robot.stiffness_Nm_rad.empty()) return out;
  for (const auto& [name, angles_deg] : robot.named_poses_deg) {
    serial::JointVector joint_rad{};
    for (std::size_t i = 0; i < angles_deg.size(); ++i) joint_rad[i] = angles_deg[i] * kDegree;
    out[name] = {{"alone_s", swings_of(robot, joint_rad, {})}, {"with_payload_s", nullptr}};
    if (scene.payload) out[name]["with_payload_s"] = swings_of(robot, joint_rad, body_of(*scene.payload));
  }
  return out;
}

}  // namespace

// A named pose in which the arm touches itself, or what it stands on, cannot be gone to.
Json checked_serial_robot(const config::SerialRobotConfig& robot, const config::SceneConfig& scene) {
  Json problems = Json::array();
  for (const auto& [name, angles_deg] : robot.named_poses_deg) {
    const std::string inside = launcher::inside_itself(robot, angles_deg);
    if (!inside.empty())
      problems.push_back("named_poses_deg." + name + ": " + inside +
                         ": choose other angles, or a thinner link_radius_m");
  }
  if (const std::string why = config::why_not_carried(robot, scene); !why.empty())
    problems.push_back("scene " + scene.name + ": " + why);
  Json notes = Json::array();
  if (simulation::SerialContact(simulation::serial_model(robot)).pairs() == 0)
    notes.push_back(
        "link_radius_m: so thick that no two links are far enough apart along the arm: it is not kept off itself");
  return {{"robot", robot.name},
          {"kind", "serial"},
          {"joints", robot.table.joint_count},
          {"swings", swings_at_poses(robot, scene)},
          {"problems", problems},
          {"notes", notes}};
}

void print_swings(const Json& swings) {
  for (const auto& [pose, periods] : swings.items()) {
    std::printf("pose %s: the locked base swings with %.1f and %.1f s", pose.c_str(),
                periods["alone_s"][0].get<double>(), periods["alone_s"][1].get<double>());
    if (!periods["with_payload_s"].is_null())
      std::printf(", with the payload with %.1f and %.1f s", periods["with_payload_s"][0].get<double>(),
                  periods["with_payload_s"][1].get<double>());
    std::printf("\n");
  }
}

}  // namespace liana::cli
