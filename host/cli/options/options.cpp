#include "host/cli/options/options.hpp"

#include <cstdio>

#include "host/cli/arguments.hpp"

namespace liana::cli {

CLI::App& add_group(CLI::App& app, const char* name, const char* text) {
  CLI::App* group = app.add_subcommand(name, text);
  group->require_subcommand(1);
  return *group;
}

CLI::Validator within(double low, double high) {
  const auto problem = [low, high](const std::string& text) -> std::string {
    double value = 0.0;
    if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return "";
    char allowed[64];
    std::snprintf(allowed, sizeof allowed, "%g to %g", low, high);
    return "'" + text + "': allowed: " + allowed;
  };
  return {problem, ""};
}

void add_seed(CLI::App& sub, std::uint64_t& seed, const std::string& what) {
  sub.add_option_function<std::string>(
         "--seed", [&seed](const std::string& text) { seed = parse_seed("--seed", text); },
         what + "; 0 to 9007199254740991")
      ->default_str("1");
}

}  // namespace liana::cli
