// Options of the commands for robot tables: robot export, check, new.
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"
#include "host/apps/cli/robot_new_questions.hpp"

namespace liana::cli {
namespace {

void add_robot_in_either_place(CLI::App& sub, std::string& robot) {
  CLI::Option* place = sub.add_option("robot", robot, "a name under lua/robots or a file")->capture_default_str();
  sub.add_option("--robot", robot, "the same as an option")->excludes(place);
}

void add_robot_export(CLI::App& group, Action& action) {
  auto [sub, exported] = add<ExportOptions>(group, action, "export", export_command);
  add_robot_in_either_place(sub, exported.robot);
  CLI::Option* urdf = sub.add_flag("--urdf", exported.urdf, "as URDF, for ROS and simulators");
  CLI::Option* mjcf = sub.add_flag("--mjcf", exported.mjcf, "as MJCF, for MuJoCo: with cables and named poses");
  sub.add_option("--scene", exported.scene, "with --urdf or --mjcf: the bodies of this scene table around it");
  sub.add_option("--out", exported.file, "file to write; standard output where not given");
  CLI::Option* json = sub.add_flag("--json")->description("the output is JSON with or without it");
  urdf->excludes(mjcf)->excludes(json);
  mjcf->excludes(json);
}

void add_robot_check(CLI::App& group, Action& action) {
  auto [sub, checked] = add<RobotCheckOptions>(group, action, "check", robot_check_command);
  add_robot_in_either_place(sub, checked.robot);
  sub.add_option("--bus", checked.bus, "bus table; where not given as for liana run");
  sub.add_option("--scene", checked.scene,
                 "scene table whose payload a serial arm carries, where its base swings; no payload where not given");
  sub.add_option("--svg", checked.svg_file, "draw the discs' holes and the cables' routing to this file");
  add_json(sub, checked.json);
}

void add_robot_new(CLI::App& group, Action& action) {
  auto [sub, made] = add<RobotNewOptions>(group, action, "new", robot_new_command);
  sub.add_option("name", made.name, "name of the robot: small letters, digits, _")->required();
  sub.add_option("--out", made.file, "file to write; NAME.lua where not given");
  sub.add_option("--segments", made.segments, about(kAskSegments));
  sub.add_option("--modules", made.modules, about(kAskModules));
  sub.add_option("--module-length", made.module_length_m, about(kAskLength));
  sub.add_option("--radius", made.radius_m, about(kAskRadius) + "; where not given, as the module length has it");
  sub.add_option("--cables", made.cables, about(kAskCables));
  sub.add_option("--theta-limit", made.theta_limit_deg, about(kAskLimit));
}

}  // namespace

void declare_robot(CLI::App& app, Action& action) {
  CLI::App& group = add_group(app, "robot");
  add_robot_export(group, action);
  add_robot_check(group, action);
  add_robot_new(group, action);
}

}  // namespace liana::cli
