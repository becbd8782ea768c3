// Robots: the table put together, alone and with the buses that carry its drives.
#include "host/model/config/campaign.hpp"
#include "host/model/config/canonical.hpp"
#include "host/model/config/drive_type.hpp"
#include "host/model/config/drive_types_of_buses.hpp"
#include "host/model/config/error_budget.hpp"
#include "host/model/config/robot_parts.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::config {
namespace {

// The robot without what the buses decide (tick, T_c).
RobotConfig read_robot(const Json& json, const std::string& file, const std::string& physics) {
  const Field table(json, file, "");
  check_kind(table, "robot", ", or serial for an arm of joints with their own drives");
  table.only({"format", "kind", "name", "segments", "module", "joint", "cables", "tension", "drives", "limits",
              "named_poses_deg", "start_pose", "jig_poses", "gravity_m_s2", "tool", "base"});
  RobotConfig out;
  out.name = table.at("name").name(40);
  read_arm(table, out);
  read_cables(table, physics, out);
  read_drives(table, out);
  read_limits(table.at("limits"), out.table.limits);
  read_named_poses(table.at("named_poses_deg"), out);
  out.start_pose = read_start_pose(table, out.named_poses_deg);
  out.jig_poses = read_jig_poses(table, out.named_poses_deg);
  out.canonical_json = canonical_json(json);
  return out;
}

void take_load_cells(const BusesConfig& buses, const std::string& file, RobotConfig& out) {
  cable::LoadCellParams& cell = out.table.load_cell;
  const auto cables = static_cast<std::size_t>(out.table.cable_count());
  for (const BusConfig& bus : buses.buses) {
    for (const LoadCellNode& node : bus.load_cells) {
      for (std::size_t i = 0; i < node.cables.size(); ++i) {
        if (node.cables[i] >= cables) {
          throw std::runtime_error(file + ": bus table " + buses.name + ": load_cells of node " +
                                   std::to_string(node.node) + ": cable " + std::to_string(node.cables[i] + 1) +
                                   ": allowed are the cables 1 to " + std::to_string(cables) + " of " + out.name +
                                   "; name another cable or use another bus table");
        }
        cell.newtons_per_step[node.cables[i]] = buses.load_cell.newtons_per_step;
        cell.zero_N[node.cables[i]] = node.zero_N[i];
      }
    }
  }
  cell.range_N = buses.load_cell.range_N;
  const double alarm_N = out.table.tension.alarm_N;
  if (cell.range_N > 0.0 && cell.range_N < alarm_N)
    throw std::runtime_error(file + ": bus table " + buses.name + ": load_cell.range_N: " + Json(cell.range_N).dump() +
                             ": allowed from " + Json(alarm_N).dump() + ", tension.alarm_N of " + out.name +
                             ": take cells that read so much, or lower the alarm");
  cell.agree_N = buses.load_cell.agree_N;
  cell.goes_on = buses.load_cell.goes_on ? 1 : 0;
}

// Drives whose type has no 6077.
void take_torqueless(const BusesConfig& buses, RobotConfig& out) {
  const std::map<std::int32_t, DriveType> types = drive_types(buses);
  for (std::size_t i = 0; i < out.drive_places.size(); ++i) {
    const auto named = types.find(out.drive_places[i].node);
    if (named != types.end() && !named->second.has_torque) out.table.no_torque |= 1u << i;
  }
}

}  // namespace

RobotConfig parse_robot(const std::string& text, const std::string& file, const std::string& physics,
                        const BusesConfig& buses) {
  RobotConfig out = read_robot(parse_json(text, file), file, physics);
  check_nodes(out.name, out.table.cable_count(), out.drive_serials, file, buses);
  out.drive_places = buses.places();
  out.machine = buses.machine;
  out.table.tick_s = buses.tick_s();
  out.table.interval_ticks = buses.interval_ticks();
  take_load_cells(buses, file, out);
  take_torqueless(buses, out);
  return out;
}

RobotConfig parse_robot_alone(const std::string& text, const std::string& file) {
  return read_robot(parse_json(text, file), file, "nominal");
}

RobotConfig load_robot(const std::string& path, const std::string& physics, const BusesConfig& buses) {
  return parse_robot(read_text_file(path), path, physics, buses);
}

std::string check_table(const std::string& kind, const Json& table, const std::string& file) {
  const std::string text = table.dump();
  if (kind == "robot" && kind_of(table) == "serial") return check_serial_robot(table, file);
  if (kind == "robot") return read_robot(table, file, "nominal").canonical_json;
  if (kind == "scene") return parse_scene(text, file).canonical_json;
  if (kind == "buses") return parse_buses(text, file).canonical_json;
  if (kind == "drive") {
    parse_drive_type(table, file);
    return canonical_json(table);
  }
  if (kind == "budget") {
    parse_error_budget(table, file);
    return canonical_json(table);
  }
  if (kind == "campaign") {
    parse_campaign(table, file);
    return canonical_json(table);
  }
  throw std::runtime_error("kind: " + kind +
                           ": allowed robot, scene, buses, drive, budget, campaign: use one of these words");
}

}  // namespace liana::config
