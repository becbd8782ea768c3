// What a campaign's database says: liana campaign show, compare, plot.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "host/apps/campaign/picture.hpp"
#include "host/apps/campaign/statistics.hpp"
#include "host/apps/campaign/store.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/base/json/json.hpp"
#include "host/base/options/nearest.hpp"

namespace liana::cli {
namespace {

using campaign::Share;
using campaign::Spread;
using campaign::Stored;
using campaign::StoredRow;
using launcher::BadInput;

constexpr std::size_t kWorst = 10;

Json share_json(const Share& share) {
  return {{"count", share.count}, {"of", share.of}, {"share", share.value()}, {"low", share.low}, {"high", share.high}};
}

Json shares_json(const std::vector<StoredRow>& rows) {
  Json shares = Json::object();
  for (const auto& [outcome, share] : campaign::outcome_shares(rows)) shares[outcome] = share_json(share);
  return shares;
}

Json spread_json(const Spread& spread) {
  return {{"count", spread.count},   {"min", spread.least}, {"p05", spread.p05}, {"p25", spread.p25},
          {"median", spread.median}, {"p75", spread.p75},   {"p95", spread.p95}, {"max", spread.most}};
}

Json spreads_json(const std::vector<StoredRow>& rows) {
  Json spreads = Json::object();
  for (const std::string& figure : campaign::figures_in(rows, false))
    spreads[figure] = spread_json(campaign::spread_of(campaign::values_of(rows, figure)));
  return spreads;
}

Json row_json(const StoredRow& row) {
  return {{"row", row.result.number},
          {"seed", row.seed},
          {"drawn", row.values},
          {"outcome", row.result.outcome},
          {"reason", row.result.reason},
          {"exit_code", row.result.exit_code},
          {"report_hash", row.result.report_hash},
          {"command", row.command},
          {"kept", row.kept.empty() ? Json() : Json(row.kept)}};
}

double cpu_s(const std::vector<StoredRow>& rows) {
  double sum_s = 0.0;
  for (const StoredRow& row : rows) sum_s += row.result.cpu_s;
  return sum_s;
}

Json summary_json(const Stored& stored) {
  Json groups = Json::array();
  for (const auto& [point, rows] : campaign::by_sweep(stored)) {
    if (!point.empty()) groups.push_back({{"point", Json::parse(point)}, {"outcomes", shares_json(rows)}});
  }
  return {{"campaign", stored.campaign.name},    {"rows", stored.campaign.rows},         {"done", stored.rows.size()},
          {"cpu_s", cpu_s(stored.rows)},         {"outcomes", shares_json(stored.rows)}, {"sweep", groups},
          {"figures", spreads_json(stored.rows)}};
}

std::string share_text(const Share& share) {
  char text[96];
  std::snprintf(text, sizeof text, "%6llu  %6.2f %% (%.2f to %.2f)", static_cast<unsigned long long>(share.count),
                100.0 * share.value(), 100.0 * share.low, 100.0 * share.high);
  return text;
}

void print_shares(const std::vector<StoredRow>& rows) {
  for (const auto& [outcome, share] : campaign::outcome_shares(rows))
    std::printf("  %-10s %s\n", outcome.c_str(), share_text(share).c_str());
}

// A figure that the rows have.
std::string known_figure(const Stored& stored, const std::string& option, const std::string& figure) {
  const std::vector<std::string> known = campaign::figures_in(stored.rows, false);
  if (std::find(known.begin(), known.end(), figure) != known.end()) return figure;
  throw BadInput(option + ": '" + figure + "': no figure of these rows; liana campaign show --json lists them" +
                 options::did_you_mean(figure, known));
}

std::vector<std::string> shown_figures(const Stored& stored, const CampaignShowOptions& options) {
  if (options.figures.empty()) return campaign::figures_in(stored.rows, true);
  std::vector<std::string> figures;
  for (const std::string& each : options.figures) figures.push_back(known_figure(stored, "--figure", each));
  return figures;
}

void print_spreads(const Stored& stored, const std::vector<std::string>& figures) {
  std::printf("  %-24s %6s %11s %11s %11s %11s %11s\n", "", "rows", "min", "5 %", "median", "95 %", "max");
  for (const std::string& figure : figures) {
    const std::vector<double> values = campaign::values_of(stored.rows, figure);
    if (values.empty()) continue;
    const Spread spread = campaign::spread_of(values);
    std::printf("  %-24s %6llu %11.5g %11.5g %11.5g %11.5g %11.5g\n", figure.c_str(),
                static_cast<unsigned long long>(spread.count), spread.least, spread.p05, spread.median, spread.p95,
                spread.most);
  }
}

void print_row(const StoredRow& row, const std::string& figure) {
  const Json& value = row.result.figures.member_or_null(figure);
  std::printf("  row %llu, seed %llu: %s", static_cast<unsigned long long>(row.result.number),
              static_cast<unsigned long long>(row.seed), row.result.outcome.c_str());
  if (value.is_number()) std::printf(", %s %.5g", figure.c_str(), value.get<double>());
  if (!row.result.reason.empty()) std::printf(": %s", row.result.reason.c_str());
  std::printf("\n    %s\n", row.command.c_str());
  if (!row.kept.empty()) std::printf("    kept in %s\n", row.kept.c_str());
}

void print_summary(const Stored& stored, const CampaignShowOptions& options) {
  std::printf("campaign %s: %zu of %llu rows, %.0f s of processor time\n", stored.campaign.name.c_str(),
              stored.rows.size(), static_cast<unsigned long long>(stored.campaign.rows), cpu_s(stored.rows));
  std::printf("outcomes, with exact binomial intervals of 95 %%:\n");
  print_shares(stored.rows);
  for (const auto& [point, rows] : campaign::by_sweep(stored)) {
    if (point.empty()) continue;
    std::printf("with %s:\n", point.c_str());
    print_shares(rows);
  }
  std::printf("figures:\n");
  print_spreads(stored, shown_figures(stored, options));
}

// Figures by which rows may be called bad: that of the option, else the first that there is.
std::string figure_of_worst(const Stored& stored, const std::string& given) {
  if (!given.empty()) return known_figure(stored, "--by", given);
  for (const char* each : {"min_clearance_m", "tip_error_m", "duration_s"}) {
    if (!campaign::values_of(stored.rows, each).empty()) return each;
  }
  return "";
}

Stored read(const std::string& file) {
  Stored stored = campaign::read_store(file);
  if (stored.rows.empty()) throw BadInput("'" + file + "': has no rows yet; let liana campaign run");
  return stored;
}

// Rows that both campaigns ran with the same configuration, and what became of them.
struct Pairs {
  std::uint64_t same_configuration = 0, same_report = 0;
  std::vector<std::pair<const StoredRow*, const StoredRow*>> other_outcome;  // with the same seed and number
};

Pairs pairs_of(const Stored& a, const Stored& b) {
  Pairs pairs;
  std::map<std::uint64_t, const StoredRow*> by_number;
  for (const StoredRow& row : b.rows) by_number[row.result.number] = &row;
  for (const StoredRow& row : a.rows) {
    const auto found = by_number.find(row.result.number);
    if (found == by_number.end() || found->second->seed != row.seed) continue;
    const StoredRow& other = *found->second;
    if (row.result.config_hash == other.result.config_hash) {
      ++pairs.same_configuration;
      pairs.same_report += row.result.report_hash == other.result.report_hash ? 1 : 0;
    }
    if (row.result.outcome != other.result.outcome) pairs.other_outcome.emplace_back(&row, &other);
  }
  return pairs;
}

void print_comparison(const Stored& a, const Stored& b, const Pairs& pairs, const CampaignShowOptions& options) {
  std::printf("A: campaign %s, %zu rows\nB: campaign %s, %zu rows\n", a.campaign.name.c_str(), a.rows.size(),
              b.campaign.name.c_str(), b.rows.size());
  std::printf("outcomes, with exact binomial intervals of 95 %%:\n");
  const std::map<std::string, Share> shares_a = campaign::outcome_shares(a.rows),
                                     shares_b = campaign::outcome_shares(b.rows);
  std::map<std::string, Share> all = shares_a;
  all.insert(shares_b.begin(), shares_b.end());
  const auto text = [](const std::map<std::string, Share>& shares, const std::string& outcome, std::size_t of) {
    const auto found = shares.find(outcome);
    return share_text(found != shares.end() ? found->second : campaign::exact_share(0, of));
  };
  for (const auto& [outcome, share] : all)
    std::printf("  %-10s A %s   B %s\n", outcome.c_str(), text(shares_a, outcome, a.rows.size()).c_str(),
                text(shares_b, outcome, b.rows.size()).c_str());
  std::printf("figures:\n  %-24s %11s %11s %11s %11s %11s %11s\n", "", "5 % A", "B", "median A", "B", "95 % A", "B");
  for (const std::string& figure : shown_figures(a, options)) {
    const std::vector<double> values = campaign::values_of(a.rows, figure),
                              others = campaign::values_of(b.rows, figure);
    if (values.empty() || others.empty()) continue;
    const Spread of_a = campaign::spread_of(values), of_b = campaign::spread_of(others);
    std::printf("  %-24s %11.5g %11.5g %11.5g %11.5g %11.5g %11.5g\n", figure.c_str(), of_a.p05, of_b.p05, of_a.median,
                of_b.median, of_a.p95, of_b.p95);
  }
  std::printf("rows with the same configuration: %llu, with the same report: %llu\n",
              static_cast<unsigned long long>(pairs.same_configuration),
              static_cast<unsigned long long>(pairs.same_report));
  std::printf("rows with another outcome: %zu\n", pairs.other_outcome.size());
  for (std::size_t i = 0; i < std::min(kWorst, pairs.other_outcome.size()); ++i) {
    const auto& [one, other] = pairs.other_outcome[i];
    std::printf("  row %llu, seed %llu: A %s, B %s\n    A: %s\n    B: %s\n",
                static_cast<unsigned long long>(one->result.number), static_cast<unsigned long long>(one->seed),
                one->result.outcome.c_str(), other->result.outcome.c_str(), one->command.c_str(),
                other->command.c_str());
  }
}

}  // namespace

int campaign_show_command(const CampaignShowOptions& options) {
  const Stored stored = read(options.databases.front());
  const std::string figure = figure_of_worst(stored, options.by);
  const std::vector<const StoredRow*> worst = campaign::worst_rows(stored.rows, figure, kWorst);
  if (options.json) {
    Json answer = summary_json(stored);
    answer["worst"] = Json::array();
    for (const StoredRow* row : worst) answer["worst"].push_back(row_json(*row));
    std::puts(answer.dump().c_str());
    return launcher::kExitOk;
  }
  print_summary(stored, options);
  std::printf("worst%s%s:\n", figure.empty() ? "" : " by ", figure.c_str());
  for (const StoredRow* row : worst) print_row(*row, figure);
  return launcher::kExitOk;
}

int campaign_compare_command(const CampaignShowOptions& options) {
  const Stored a = read(options.databases.front()), b = read(options.databases.back());
  const Pairs pairs = pairs_of(a, b);
  if (!options.json) {
    print_comparison(a, b, pairs, options);
    return launcher::kExitOk;
  }
  Json other = Json::array();
  for (const auto& [one, two] : pairs.other_outcome) other.push_back({{"a", row_json(*one)}, {"b", row_json(*two)}});
  const Json answer = {{"a", summary_json(a)},
                       {"b", summary_json(b)},
                       {"same_configuration", pairs.same_configuration},
                       {"same_report", pairs.same_report},
                       {"other_outcome", other}};
  std::puts(answer.dump().c_str());
  return launcher::kExitOk;
}

int campaign_plot_command(const CampaignShowOptions& options) {
  if (options.databases.size() > 2) throw BadInput("plot: more than two databases; give one or two");
  std::vector<Stored> campaigns;
  for (const std::string& file : options.databases) campaigns.push_back(read(file));
  const std::vector<std::string> figures = shown_figures(campaigns.front(), options);
  const std::string file = options.svg_file.empty() ? campaigns.front().campaign.name + ".svg" : options.svg_file;
  launcher::check_output("--svg", file);
  launcher::write_output(file, campaign::picture_of(campaigns, figures));
  if (options.json) {
    std::puts(Json{{"svg", file}, {"figures", Json(figures)}}.dump().c_str());
  } else {
    std::printf("%s\n", file.c_str());
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
