#include "host/apps/cli/known_values.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "host/base/install_paths/places.hpp"

namespace liana::cli {
namespace {

namespace fs = std::filesystem;

constexpr KnownValues kValues[] = {
    {"--robot", "robots", "", true},
    {"--scene", "scenes", "", true},
    {"--bus", "buses", "", true},
    {"--buses", "buses", "", true},
    {"--type", "drives", "", true},
    {"--follow", "", "slit", true},
    {"--time", "", "fast paced real", false},
    {"--physics", "", "nominal ideal worn", false},
    {"--true-physics", "", "nominal ideal worn", false},
    {"--operator", "", "recorded model", false},
    {"--feedback", "", "aligned claim abstract off", false},
    {"--fixtures", "", "on off", false},
    {"--passivity", "", "on off", false},
    {"--temper", "", "gentle lively", false},
    {"--gravity", "", "0.01", false},
    {"--linkage-error", "", "0.01", false},
    {"--arm", "", "full light", false},
    {"--rate", "", "250 500", false},
    {"--record", "", "", true},
    {"--calibration", "", "", true},
    {"--faults", "", "", true},
    {"--svg", "", "", true},
    {"--path", "", "", true},
    {"--api", "", "", true},
    {"--out", "", "", true},
    {"--csv", "", "", true},
    {"--mcap", "", "", true},
    {"--candump", "", "", true},
    {"--tracker", "", "", true},
    {"--run", "", "", true},
    {"--token-file", "", "", true},
    {"--cert", "", "", true},
    {"--key", "", "", true},
    {"--lua-dir", "", "", true},
    {"liana run", "missions", "", true},
    {"liana check", "missions", "", true},
    {"liana robot export", "robots", "", true},
    {"liana robot check", "robots", "", true},
    {"liana budget", "budgets", "", true},
    {"liana campaign", "campaigns", "", true},
    {"--engine", "", "local slurm", false},
    {"liana mission", "", "pause resume step confirm abort", false},
    {"liana completion", "", "bash zsh", false},
    {"liana replay", "", "", true},
    {"liana commands", "", "", true},
    {"liana view", "", "", true},
};

}  // namespace

std::span<const KnownValues> known_values() { return kValues; }

std::vector<std::string> table_names(const std::string& table) {
  std::set<std::string> names;
  for (const std::string& folder : install_paths::lua_folders()) {
    std::error_code unreadable;
    for (const auto& entry : fs::directory_iterator(fs::path(folder) / table, unreadable)) {
      if (entry.path().extension() == ".lua") names.insert(entry.path().stem().string());
    }
  }
  return {names.begin(), names.end()};
}

std::vector<std::string> values_after(const std::string& option_or_command) {
  const auto row = std::find_if(std::begin(kValues), std::end(kValues),
                                [&](const KnownValues& values) { return values.after == option_or_command; });
  if (row == std::end(kValues)) return {};
  std::vector<std::string> values = *row->table == '\0' ? std::vector<std::string>() : table_names(row->table);
  std::istringstream words(row->words);
  for (std::string word; words >> word;) values.push_back(word);
  return values;
}

}  // namespace liana::cli
