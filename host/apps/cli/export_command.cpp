#include <cstdio>

#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"
#include "host/model/description/formats.hpp"

namespace liana::cli {
namespace {

std::string table_text(const std::string& robot) {
  const std::string text = launcher::evaluate_table("robot", robot);
  return launcher::checked([&] { return config::check_table("robot", config::parse_json(text, robot), robot); }) + "\n";
}

description::RobotTree tree_of(const std::string& robot) {
  if (const auto serial = launcher::serial_robot_for_kinematics(robot)) return description::tree_of(*serial);
  return description::tree_of(launcher::robot_for_kinematics(robot));
}

std::string model_text(const ExportOptions& options) {
  std::vector<description::Shape> scene;
  if (!options.scene.empty()) scene = description::shapes_of(launcher::scene_of(options.scene));
  const description::RobotTree tree = tree_of(options.robot);
  return options.urdf ? description::urdf(tree, scene) : description::mjcf(tree, scene);
}

}  // namespace

int export_command(const ExportOptions& options) {
  const bool is_model = options.urdf || options.mjcf;
  if (!options.scene.empty() && !is_model)
    throw launcher::BadInput("robot export: --scene " + options.scene +
                             ": the table as JSON has no scene; allowed with --urdf or --mjcf: add one of them");
  if (!options.file.empty()) launcher::check_output("--out", options.file);
  const std::string text = is_model ? model_text(options) : table_text(options.robot);
  if (options.file.empty()) {
    std::fputs(text.c_str(), stdout);
  } else {
    launcher::write_output(options.file, text);
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
