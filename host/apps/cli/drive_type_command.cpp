// `liana drive type`: a drive type from an electronic data sheet.
#include <cstdio>
#include <filesystem>

#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/file/in_file.hpp"
#include "host/base/json/json.hpp"
#include "host/drives/commissioning/type_from_eds.hpp"

namespace liana::cli {
namespace {

constexpr std::uintmax_t kMaxBytes = 8 << 20;  // sheets of drives have a few hundred thousand

std::string read_sheet(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw launcher::BadInput("--from-eds: " + path + ": no ordinary file: allowed is the EDS or DCF of a drive");
  if (std::filesystem::file_size(path, error) > kMaxBytes || error)
    throw launcher::BadInput("--from-eds: " + path + ": allowed are files of at most " +
                             std::to_string(kMaxBytes >> 20) + " MiB");
  const auto text = file::content_of(path);
  if (!text) throw launcher::BadInput("--from-eds: " + path + ": cannot be read: check its permissions");
  return *text;
}

// The name of a file in a table: only letters that a table takes.
std::string plain_name(const std::string& path) {
  std::string name = std::filesystem::path(path).filename().string().substr(0, 80);
  for (char& c : name)
    if (c < 0x20 || c > 0x7E || c == '"' || c == '\\') c = '?';
  return name;
}

Json lines_json(const std::vector<std::string>& lines) {
  Json out = Json::array();
  for (const std::string& line : lines) out.push_back(line);
  return out;
}

}  // namespace

int drive_type_command(const DriveOptions& options) {
  if (options.mode != "csp" && options.mode != "cst")
    throw launcher::BadInput("--mode: '" + options.mode + "': allowed are csp and cst");
  const std::string text = read_sheet(options.eds);
  if (options.out != "-") launcher::check_output("--out", options.out);
  const commissioning::Eds eds = launcher::checked([&] { return commissioning::parse_eds(text, options.eds); });
  const commissioning::TypeFromEds type =
      commissioning::type_from_eds(eds, options.mode == "cst", plain_name(options.eds));
  const bool is_good = type.missing.empty();
  if (is_good && options.out != "-") launcher::write_output(options.out, type.table);
  if (options.json) {
    const Json said = {{"ok", is_good},
                       {"name", type.name},
                       {"mode", options.mode},
                       {"objects", eds.objects.size()},
                       {"missing", lines_json(type.missing)},
                       {"notes", lines_json(type.notes)},
                       {"table", type.table}};
    std::printf("%s\n", said.dump().c_str());
  } else {
    if (is_good && options.out == "-") std::printf("%s", type.table.c_str());
    for (const std::string& each : type.missing) std::fprintf(stderr, "missing: %s\n", each.c_str());
    for (const std::string& each : type.notes) std::fprintf(stderr, "note: %s\n", each.c_str());
  }
  if (!is_good)
    std::fprintf(stderr, "liana: %s: no type for %s was made: %zu things are missing\n", options.eds.c_str(),
                 options.mode.c_str(), type.missing.size());
  else if (options.out != "-" && !options.json)
    std::printf("%s: type %s, from %zu objects; next: liana drive check --type %s\n", options.out.c_str(),
                type.name.c_str(), eds.objects.size(), options.out.c_str());
  return is_good ? launcher::ExitCode::kExitOk : launcher::ExitCode::kExitFailure;
}

}  // namespace liana::cli
