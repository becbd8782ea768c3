#include "host/apps/cli/options/options.hpp"

#include <cstdio>

#include "host/apps/cli/arguments.hpp"

namespace liana::cli {

CLI::App& add_group(CLI::App& app, const char* name) {
  CLI::App* group = app.add_subcommand(name);
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

void add_robot(CLI::App& sub, std::string& robot) {
  sub.add_option("--robot", robot, "robot table: a name under lua/robots or a file")->capture_default_str();
}

void add_json(CLI::App& sub, bool& json) { sub.add_flag("--json", json, "print JSON"); }

void add_physics(CLI::App& sub, std::string& physics, const std::string& of_what) {
  sub.add_option("--physics", physics, of_what + "nominal, ideal or worn")
      ->capture_default_str()
      ->check(CLI::IsMember({"nominal", "ideal", "worn"}));
}

void add_cross_wired(CLI::App& sub, std::string& drives) {
  sub.add_option("--cross-wired", drives,
                 "to try it out: two drives of the simulated arm, counted from 1, e.g. 4,5, have each other's cable");
}

void add_control_points(CLI::App& sub, std::vector<std::string>& targets) {
  sub.add_option("--control-point", targets,
                 "node target NODE:x,y,z[:WEIGHT]; may be repeated; WEIGHT is 1 for the arm's middle node and 0.25 "
                 "for others where not given")
      ->take_all()
      ->allow_extra_args(false);
}

void add_seed(CLI::App& sub, std::uint64_t& seed, const std::string& what) {
  sub.add_option_function<std::string>(
         "--seed", [&seed](const std::string& text) { seed = parse_seed("--seed", text); },
         what + "; 0 to 9007199254740991")
      ->default_str("1");
}

}  // namespace liana::cli
