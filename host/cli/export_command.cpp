#include <cstdio>
#include <fstream>

#include "host/cli/commands.hpp"
#include "host/cli/tables.hpp"

namespace liana {

int export_command(const ExportOptions& options) {
  const std::string table = evaluate_table("robot", options.robot);
  if (options.file.empty()) return std::fputs(table.c_str(), stdout) < 0 ? kExitFailure : kExitOk;
  std::ofstream file(options.file);
  file << table;
  file.close();
  if (!file) throw BadInput(options.file + ": cannot be written; give a file in a directory that exists");
  return kExitOk;
}

}  // namespace liana
