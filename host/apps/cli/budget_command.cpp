#include <cstdio>

#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/field.hpp"
#include "host/planning/error_budget/budget.hpp"
#include "host/planning/error_budget/monte_carlo.hpp"
#include "host/planning/error_budget/picture.hpp"

namespace liana::cli {
namespace {

Json contributions_json(const config::ErrorLoop& loop) {
  Json list = Json::array();
  for (const config::ErrorTerm& term : loop.terms)
    list.push_back({{"name", term.name}, {"size_m", error_budget::size_m(loop, term)}});
  return list;
}

Json readings_json(const error_budget::Readings& readings) {
  return {{"terms_m", readings.terms},
          {"sum_m", readings.sum},
          {"apart_m", readings.apart},
          {"independent_m", readings.independent}};
}

Json spread_json(const error_budget::Spread& spread) {
  return {{"median_m", spread.median_m},
          {"p95_m", spread.p95_m},
          {"worst_m", spread.worst_m},
          {"within_formula", spread.within_formula}};
}

void print_loop(const char* title, const config::ErrorLoop& loop, const error_budget::Spread& spread) {
  const error_budget::Readings readings = error_budget::readings_of(loop);
  std::printf("%s\n", title);
  for (const config::ErrorTerm& term : loop.terms)
    std::printf("  %-40s %8.2f mm\n", term.name.c_str(), 1e3 * error_budget::size_m(loop, term));
  std::printf("  %-40s %8.2f mm\n", "root of the sum of squares", 1e3 * readings.terms);
  std::printf("  other readings: sum %.1f, all apart %.1f, positions and angles independent %.1f mm\n",
              1e3 * readings.sum, 1e3 * readings.apart, 1e3 * readings.independent);
  std::printf("  by chance: median %.1f, 95 %% within %.1f, worst %.1f mm; %.1f %% within the formula\n",
              1e3 * spread.median_m, 1e3 * spread.p95_m, 1e3 * spread.worst_m, 100.0 * spread.within_formula);
}

}  // namespace

int budget_command(const BudgetOptions& options) {
  const std::int64_t draws = parse_whole("--draws", options.draws, error_budget::kMinDraws, error_budget::kMaxDraws);
  if (!options.svg_file.empty()) launcher::check_output("--svg", options.svg_file);
  const std::string text = launcher::evaluate_table("budget", options.budget);
  const config::ErrorBudget budget = launcher::checked(
      [&] { return config::parse_error_budget(config::parse_json(text, options.budget), options.budget); });
  const error_budget::Spread open = error_budget::draw(budget.open_loop, draws, options.seed);
  const error_budget::Spread closed = error_budget::draw(budget.closed_loop, draws, options.seed);
  if (!options.svg_file.empty())
    launcher::write_output(options.svg_file, error_budget::picture_of(budget, open, closed));
  if (options.json) {
    const error_budget::Readings open_loop = error_budget::readings_of(budget.open_loop);
    const error_budget::Readings closed_loop = error_budget::readings_of(budget.closed_loop);
    const Json answer = {
        {"budget", budget.name},
        {"open_loop_m", open_loop.terms},
        {"closed_loop_m", closed_loop.terms},
        {"contributions",
         {{"open_loop", contributions_json(budget.open_loop)},
          {"closed_loop", contributions_json(budget.closed_loop)}}},
        {"readings", {{"open_loop", readings_json(open_loop)}, {"closed_loop", readings_json(closed_loop)}}},
        {"monte_carlo",
         {{"draws", draws},
          {"seed", options.seed},
          {"sigmas", error_budget::kSigmas},
          {"open_loop", spread_json(open)},
          {"closed_loop", spread_json(closed)}}}};
    std::puts(answer.dump().c_str());
  } else {
    print_loop("open loop", budget.open_loop, open);
    print_loop("led by the camera", budget.closed_loop, closed);
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
