#include <cstdio>

#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/config.hpp"
#include "host/model/config/field.hpp"

namespace liana::cli {

int export_command(const ExportOptions& options) {
  if (!options.file.empty()) launcher::check_output("--out", options.file);
  const std::string text = launcher::evaluate_table("robot", options.robot);
  const std::string table =
      launcher::checked(
          [&] { return config::check_table("robot", config::parse_json(text, options.robot), options.robot); }) +
      "\n";
  if (options.file.empty()) {
    std::fputs(table.c_str(), stdout);
  } else {
    launcher::write_output(options.file, table);
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
