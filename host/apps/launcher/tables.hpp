// Robot, scene and bus tables by name: evaluated by `liana-mission eval`, the only place where Lua tables are read.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "host/apps/launcher/errors.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/serial_robot.hpp"

namespace liana::launcher {

// Canonical JSON of a table; kind is robot, scene or buses, `name` a name under lua/ or a file (.lua, or .json as
// exported). Throws BadInput with the evaluator's one message.
std::string evaluate_table(const std::string& kind, const std::string& name);

// Checks a mission script against robot and buses (names, or exported JSON) without running it, and returns its
// description (lua/liana/check.lua); throws BadInput with the evaluator's one message.
Json check_mission(const std::string& name, const std::string& robot, const std::string& bus);

// The tables that a mission script says it runs with; empty: it says none. Throws as check_mission does.
struct MissionTables {
  std::string robot, scene, bus;
};
MissionTables tables_of_mission(const std::string& name);

// Runs a loader of host/model/config and turns its refusal into BadInput.
template <typename Loader>
auto checked(const Loader& loader) {
  try {
    return loader();
  } catch (const std::runtime_error& error) {
    throw BadInput(error.what());
  }
}

constexpr const char* kDefaultRobot = "zhu2022";

// A scene, checked.
config::SceneConfig scene_of(const std::string& name);

// A table that was found or made: what messages call it, and its canonical JSON.
struct TableText {
  std::string name;
  std::string json;
};

// The bus table of a robot: `given`; where that is empty embedded_ROBOT if there is such a table, `embedded` for as
// many drives as that has, else one made for the drives of `robot_json` (config/bench_buses.hpp).
TableText buses_of(const std::string& robot, const std::string& robot_json, const std::string& given);

// A cable robot as commands need it that move nothing, on the buses that it would be simulated with.
config::RobotConfig robot_for_kinematics(const std::string& name);

// The same for a serial arm, without buses; empty when the robot is of another kind.
std::optional<config::SerialRobotConfig> serial_robot_for_kinematics(const std::string& name);

}  // namespace liana::launcher
