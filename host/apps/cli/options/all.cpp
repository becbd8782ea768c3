// The whole command line: what stands before the command, every command, and those about the host and help.
#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/options/options.hpp"
#include "host/apps/cli/options/tasks.hpp"
#include "host/apps/cli/options/words.hpp"
#include "host/base/install_paths/places.hpp"

namespace liana::cli {
namespace {

// What stands before the command: for every command the same.
void declare_global(CLI::App& app) {
  app.require_subcommand(1);
  app.set_version_flag("--version", "liana " LIANA_VERSION, "say which version");
  app.add_option_function<std::string>(
      kLuaDir, [](const std::string& folder) { install_paths::search_first(kLuaDir, folder); },
      "before the command: a folder of tables and missions that is searched first (docs/how-to/install.md)");
}

void declare_help(CLI::App& app, Action& action) {
  auto [doctor, options] = add<DoctorOptions>(app, action, "doctor", doctor_command);
  add_json(doctor, options.json);

  CLI::App* completion = app.add_subcommand("completion");
  const auto shell = std::make_shared<std::string>("bash");
  completion->add_option("shell", *shell, "bash or zsh; or robots, scenes, buses, missions: the names that there are")
      ->capture_default_str();
  completion->callback(
      [&app, &action, shell] { action = [&app, shell] { return completion_command(*shell, help_of(app, "liana")); }; });
  app.add_subcommand("help");
}

}  // namespace

void declare_all(CLI::App& app, Action& action) {
  declare_global(app);
  declare_geometry(app, action);
  declare_missions(app, action);
  declare_seeing(app, action);
  declare_arm(app, action);
  declare_device(app, action);
  declare_drive(app, action);
  declare_robot(app, action);
  declare_help(app, action);
  explain(app);
}

}  // namespace liana::cli
