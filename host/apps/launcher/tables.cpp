#include "host/apps/launcher/tables.hpp"

#include <algorithm>
#include <filesystem>

#include "host/apps/launcher/process.hpp"
#include "host/base/install_paths/places.hpp"
#include "host/model/config/bench_buses.hpp"
#include "host/model/config/field.hpp"

namespace liana::launcher {
namespace {

namespace fs = std::filesystem;

constexpr std::int32_t kDrivesOfEmbedded = 15;

// The evaluator's first line, without its program name: one message for the user.
std::string first_message(const Captured& captured) {
  std::string line = captured.error.substr(0, captured.error.find('\n'));
  const std::string prefix = "liana-mission: ";
  if (line.starts_with(prefix)) line.erase(0, prefix.size());
  return line.empty() ? "liana-mission eval ended with code " + std::to_string(captured.code) + " and no message"
                      : line;
}

std::string evaluate(std::vector<std::string> words) {
  words.insert(words.begin(), {sibling_program("liana-mission"), "eval"});
  const Captured captured = run_and_capture(words);
  if (captured.code != 0) throw BadInput(first_message(captured));
  return captured.out;
}

std::string read_file(const std::string& path) {
  return checked([&] { return config::read_text_file(path); });
}

// Whether a Lua folder has a table of this name.
bool is_shipped_or_own(const std::string& kind, const std::string& name) {
  const std::vector<std::string> folders = checked(install_paths::lua_folders);
  return std::any_of(folders.begin(), folders.end(),
                     [&](const std::string& folder) { return fs::exists(folder + "/" + kind + "/" + name + ".lua"); });
}

void refuse_directory(const std::string& kind, const std::string& name) {
  std::error_code unreadable;
  const bool is_file = name.find('/') != std::string::npos || name.ends_with(".json");
  if (is_file && std::filesystem::is_directory(name, unreadable)) {
    throw BadInput(kind + ": '" + name + "': is a directory; give a name or an existing file");
  }
}

}  // namespace

std::string evaluate_table(const std::string& kind, const std::string& name) {
  refuse_directory(kind, name);
  return name.ends_with(".json") ? read_file(name) : evaluate({"--", kind, name});
}

Json check_mission(const std::string& name, const std::string& robot, const std::string& bus) {
  refuse_directory("mission", name);
  return Json::parse(evaluate({"--robot=" + robot, "--bus=" + bus, "--", "mission", name}));
}

MissionTables tables_of_mission(const std::string& name) {
  refuse_directory("mission", name);
  const Json said = Json::parse(evaluate({"--", "mission_tables", name}));
  return {said.value("robot", ""), said.value("scene", ""), said.value("bus", "")};
}

config::SceneConfig scene_of(const std::string& name) {
  const std::string scene = evaluate_table("scene", name);
  return checked([&] { return config::parse_scene(scene, name); });
}

TableText buses_of(const std::string& robot, const std::string& robot_json, const std::string& given) {
  if (!given.empty()) return {given, evaluate_table("buses", given)};
  const std::string own = "embedded_" + robot;
  if (is_shipped_or_own("buses", own)) return {own, evaluate_table("buses", own)};
  const std::int32_t drives = checked([&] { return config::drive_count(robot_json, robot); });
  if (drives == kDrivesOfEmbedded) return {"embedded", evaluate_table("buses", "embedded")};
  return {"bench_" + std::to_string(drives), config::bench_buses(drives)};
}

config::RobotConfig robot_for_kinematics(const std::string& name) {
  const std::string robot = evaluate_table("robot", name);
  if (checked([&] { return config::robot_kind(robot, name); }) == "serial")
    throw BadInput(
        "--robot: '" + name +
        "': has a serial arm: allowed a cable arm; for a serial arm take liana ik, liana sweep, or a mission "
        "with move_jp and move_cp");
  return checked([&] {
    const TableText buses = buses_of(name, robot, "");
    return config::parse_robot(robot, name, "nominal", config::parse_buses(buses.json, buses.name));
  });
}

std::optional<config::SerialRobotConfig> serial_robot_for_kinematics(const std::string& name) {
  const std::string robot = evaluate_table("robot", name);
  return checked([&]() -> std::optional<config::SerialRobotConfig> {
    if (config::robot_kind(robot, name) != "serial") return std::nullopt;
    return config::parse_serial_robot(robot, name);
  });
}

}  // namespace liana::launcher
