#include "host/apps/cli/carry_report.hpp"

#include <cstdio>

#include "host/apps/cli/pose_json.hpp"
#include "host/model/config/drive_names.hpp"

namespace liana::cli {
namespace {

Json json_of(const config::RobotConfig& robot, const workspace::Payload& payload) {
  return {{"mass_kg", payload.mass_kg},     {"unloaded", payload.unloaded},
          {"cable", payload.cable + 1},     {"cable_name", config::DriveNames(robot.table).cable(payload.cable)},
          {"tension_N", payload.tension_N}, {"theta_deg", degrees_json(payload.theta_rad, robot.table.theta_count())}};
}

void print_payload(const char* poses, const Json& payload) {
  const std::string cable = payload["cable_name"].get<std::string>();
  const double tension_N = payload["tension_N"].get<double>();
  if (payload["unloaded"].get<bool>()) {
    std::printf("; %s: payload up to %.3f kg (%s, %.0f N)", poses, payload["mass_kg"].get<double>(), cable.c_str(),
                tension_N);
  } else {
    std::printf("; %s: not even without payload (%s, %.0f N)", poses, cable.c_str(), tension_N);
  }
}

}  // namespace

std::vector<workspace::Carried> all_carried(const config::RobotConfig& robot, std::int32_t samples,
                                            std::uint64_t seed) {
  std::vector<workspace::Carried> out;
  for (const workspace::Mounting& mounting : workspace::mountings(robot.table))
    out.push_back(workspace::what_it_carries(robot, mounting, samples, seed));
  return out;
}

Json carry_json(const config::RobotConfig& robot, const std::vector<workspace::Carried>& carried) {
  const config::DriveNames names(robot.table);
  Json list = Json::array();
  for (const workspace::Carried& one : carried) {
    const bool has_weight = norm(one.mounting.gravity_m_s2) > 0.0;
    list.push_back({{"mounting", one.mounting.name},
                    {"gravity_m_s2", one.mounting.gravity_m_s2},
                    {"share",
                     {{"up_to_ceiling", one.share[0]},
                      {"over_ceiling", one.share[1]},
                      {"over_alarm", one.share[2]},
                      {"over_limit", one.share[3]}}},
                    {"ceiling_N", robot.table.tension.ceiling_free_N},
                    {"hardest",
                     {{"tension_N", one.worst.max_N},
                      {"cable", one.worst.max_cable + 1},
                      {"cable_name", names.cable(one.worst.max_cable)},
                      {"theta_deg", degrees_json(one.worst_rad, robot.table.theta_count())}}},
                    {"payload_named_poses", has_weight ? json_of(robot, one.named) : Json()},
                    {"payload_all_poses", has_weight ? json_of(robot, one.all) : Json()}});
  }
  return list;
}

void print_carry(const Json& carries) {
  for (const Json& one : carries) {
    const Json &share = one["share"], &hardest = one["hardest"];
    std::printf(
        "%s: %.1f %% of poses up to the ceiling of %g N, %.1f %% over it, %.1f %% over the alarm, %.1f %% over "
        "the limit; hardest %.0f N (%s)",
        one["mounting"].get<std::string>().c_str(), 100.0 * share["up_to_ceiling"].get<double>(),
        one["ceiling_N"].get<double>(), 100.0 * share["over_ceiling"].get<double>(),
        100.0 * share["over_alarm"].get<double>(), 100.0 * share["over_limit"].get<double>(),
        hardest["tension_N"].get<double>(), hardest["cable_name"].get<std::string>().c_str());
    if (!one["payload_all_poses"].is_null()) {
      print_payload("named poses", one["payload_named_poses"]);
      print_payload("hardest poses found", one["payload_all_poses"]);
    }
    std::printf("\n");
  }
}

}  // namespace liana::cli
