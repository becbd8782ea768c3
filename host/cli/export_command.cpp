#include <cstdio>

#include "host/cli/commands.hpp"
#include "host/system/output.hpp"
#include "host/system/tables.hpp"

namespace liana {

int export_command(const ExportOptions& options) {
  if (!options.file.empty()) check_output("--out", options.file);
  const std::string table = evaluate_table("robot", options.robot);
  if (options.file.empty()) {
    std::fputs(table.c_str(), stdout);
  } else {
    write_output(options.file, table);
  }
  return kExitOk;
}

}  // namespace liana
