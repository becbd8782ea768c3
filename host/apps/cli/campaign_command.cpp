#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "host/apps/campaign/engine.hpp"
#include "host/apps/campaign/progress.hpp"
#include "host/apps/campaign/rows.hpp"
#include "host/apps/campaign/slurm_engine.hpp"
#include "host/apps/campaign/store.hpp"
#include "host/apps/cli/arguments.hpp"
#include "host/apps/cli/commands.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/interrupt.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/process.hpp"
#include "host/apps/launcher/tables.hpp"
#include "host/base/json/json.hpp"
#include "host/model/config/campaign.hpp"
#include "host/model/config/field.hpp"
#include "host/model/config/sha256.hpp"

namespace liana::cli {
namespace {

namespace fs = std::filesystem;
using campaign::Row;
using campaign::RowResult;
using launcher::BadInput;

constexpr std::int64_t kMaxJobs = 1024;
constexpr const char* kSlurmFolder = ".slurm";  // behind the database's name
constexpr std::uint64_t kSaidRows = 5000;       // so many are checked within moments

struct LoadedCampaign {
  Json table;  // without its folder
  std::string folder;
  campaign::Rows rows;
};

LoadedCampaign load(const std::string& file) {
  if (file.empty())
    throw BadInput("campaign: no table given; allowed: a name under lua/campaigns, a file, or show, compare, plot");
  Json table = launcher::checked([&] { return config::parse_json(launcher::evaluate_table("campaign", file), file); });
  std::string folder = fs::absolute(fs::path(file)).parent_path().string();
  if (const Json* told = table.find("folder"); told != nullptr && told->is_string()) folder = told->text();
  if (table.is_object()) table.erase("folder");
  config::CampaignConfig config = launcher::checked([&] { return config::parse_campaign(table, file); });
  return {std::move(table), folder, campaign::Rows(std::move(config), folder)};
}

// What a campaign says itself is no option of its rows.
void check_keys(const config::CampaignConfig& config) {
  const std::set<std::string> own{"json", "record", "lean", "console", "seed", "time", "help", "version"};
  const auto check = [&](const std::string& key) {
    if (own.count(key) != 0)
      throw BadInput("campaign " + config.name + ": " + key + ": the campaign decides this; leave it out");
  };
  for (const auto& [key, value] : config.options) check(key);
  for (const config::Swept& each : config.sweep) check(each.key);
  for (const config::Drawn& each : config.draw) check(each.key);
}

// "3,7-9" as numbers, each once, in order.
std::vector<std::uint64_t> parse_rows(const std::string& text, std::uint64_t count) {
  std::set<std::uint64_t> rows;
  std::istringstream list(text);
  const auto number = [&](const std::string& word) {
    return static_cast<std::uint64_t>(
        parse_whole("--rows", word, 0, static_cast<std::int64_t>(count) - 1, ", the rows of this campaign"));
  };
  for (std::string word; std::getline(list, word, ',');) {
    const std::size_t dash = word.find('-', 1);
    const std::uint64_t first = number(word.substr(0, dash));
    const std::uint64_t last = dash == word.npos ? first : number(word.substr(dash + 1));
    if (last < first) throw BadInput("--rows: '" + word + "': allowed FIRST-LAST with FIRST at most LAST");
    for (std::uint64_t row = first; row <= last; ++row) rows.insert(row);
  }
  if (rows.empty()) throw BadInput("--rows: '" + text + "': allowed numbers and ranges, e.g. 3,7-9");
  return {rows.begin(), rows.end()};
}

// Every row is a line that liana run takes, before the first one runs; rows that are there are those of this table.
void check_rows(const CampaignOptions& options, campaign::Rows& rows, const std::vector<std::uint64_t>& numbers,
                const std::map<std::uint64_t, std::string>& done) {
  if (numbers.size() > kSaidRows) std::fprintf(stderr, "checking %zu rows\n", numbers.size());
  for (const std::uint64_t number : numbers) {
    const Row row = rows.at(number);
    try {
      options.check_words(row.words);
    } catch (const BadInput& problem) {
      throw BadInput("campaign " + rows.config().name + ": row " + std::to_string(number) + ": " + problem.what());
    }
    const auto found = done.find(number);
    if (found != done.end() && found->second != row.config_hash)
      throw BadInput("--out: '" + options.out + "': row " + std::to_string(number) +
                     " was made with other tables, missions or files; give another file to --out");
  }
}

std::string programs_hash() {
  std::string all;
  for (const char* name : {"liana", "liana-bus", "lianad", "liana-bench", "liana-mission", "liana-operator"})
    all += config::sha256_hex(config::read_text_file(launcher::sibling_program(name))) + "\n";
  return config::sha256_hex(all);
}

// For a shell: what repeats one row.
std::string command_of(const CampaignOptions& options, const Row& row) {
  const std::string number = std::to_string(row.number);
  return "liana " +
         (row.tables.empty()
              ? campaign::shell_line(row.words)
              : campaign::shell_line({"campaign", options.file, "--rows=" + number, "--full=row-" + number}));
}

// Rows that were asked for by number: kept in full, or as one JSON file each.
int run_rows(const CampaignOptions& options, campaign::Engine& engine, campaign::Progress& progress,
             const launcher::InterruptGuard& interrupts, const std::vector<std::uint64_t>& numbers) {
  const std::string folder = fs::absolute(options.results.empty() ? options.full : options.results);
  fs::create_directories(folder);
  std::size_t done = 0, successes = 0;
  const std::string full = options.full.empty() ? "" : fs::absolute(options.full).string();
  engine.run({numbers, full}, [&](const RowResult& result) {
    ++done;
    successes += result.outcome == "success" ? 1 : 0;
    progress.row_done(result.outcome == "success");
    if (!options.results.empty())
      launcher::write_output(campaign::folder_of_row(folder, result.number) + ".json", to_json(result).dump() + "\n");
    if (options.json) std::puts(to_json(result).dump().c_str());
  });
  if (interrupts.count() > 0) throw launcher::Interrupted("campaign: interrupted; not all rows are done");
  if (!options.json) std::printf("%zu of %zu rows, %zu success: %s\n", done, numbers.size(), successes, folder.c_str());
  return done == numbers.size() ? launcher::kExitOk : launcher::kExitFailure;
}

void repeat_failed(const CampaignOptions& options, const campaign::Rows& rows, campaign::Store& store,
                   campaign::Engine& engine, campaign::Progress& progress, bool& is_repeatable) {
  const std::vector<std::uint64_t> failed = store.failed_not_kept(rows.config().keep_failed);
  if (failed.empty()) return;
  const std::string folder = fs::absolute(options.out).string() + ".failed";
  progress.say(std::to_string(failed.size()) + " failed rows are repeated and kept in full in " + folder);
  engine.run({failed, folder}, [&](const RowResult& result) {
    if (store.put_kept(result, campaign::folder_of_row(folder, result.number))) return;
    is_repeatable = false;
    progress.say("row " + std::to_string(result.number) + ": the repeated run gave another report");
  });
}

int say_end(const CampaignOptions& options, std::uint64_t rows, bool is_repeatable) {
  const campaign::Stored stored = campaign::read_store(options.out);
  std::map<std::string, std::uint64_t> outcomes;
  double cpu_s = 0.0;
  std::string refusal;
  for (const campaign::StoredRow& row : stored.rows) {
    ++outcomes[row.result.outcome];
    cpu_s += row.result.cpu_s;
    if (row.result.outcome == "refused" && refusal.empty())
      refusal = "row " + std::to_string(row.result.number) + ": " + row.result.reason;
  }
  std::string words;
  for (const auto& [outcome, count] : outcomes)
    words += (words.empty() ? "" : ", ") + std::to_string(count) + " " + outcome;
  if (options.json) {
    const Json answer = {{"campaign", stored.campaign.name}, {"out", options.out},         {"rows", rows},
                         {"done", stored.rows.size()},       {"outcomes", Json(outcomes)}, {"cpu_s", cpu_s}};
    std::puts(answer.dump().c_str());
  } else {
    std::printf("%zu of %llu rows: %s; %s of processor time\nliana campaign show %s\n", stored.rows.size(),
                static_cast<unsigned long long>(rows), words.c_str(), campaign::duration_text(cpu_s).c_str(),
                campaign::shell_line({options.out}).c_str());
  }
  if (!refusal.empty())
    std::fprintf(stderr, "liana: campaign: liana run refused rows, the first is %s\n", refusal.c_str());
  const bool is_whole = stored.rows.size() == rows && refusal.empty() && is_repeatable;
  return is_whole ? launcher::kExitOk : launcher::kExitFailure;
}

// Of the local engine; refuses what does not go with the engine that was asked for.
std::size_t jobs_of(const CampaignOptions& options) {
  if (options.engine == "slurm") {
    if (!options.rows.empty()) throw BadInput("--rows: goes with --engine local; leave one of the two out");
    if (!options.jobs.empty()) throw BadInput("--jobs: goes with --engine local; Slurm decides; leave it out");
  }
  if (options.jobs.empty()) return campaign::processors();
  return static_cast<std::size_t>(parse_whole("--jobs", options.jobs, 1, kMaxJobs));
}

std::unique_ptr<campaign::Engine> engine_of(const CampaignOptions& options, std::size_t jobs, LoadedCampaign& loaded,
                                            const launcher::InterruptGuard& interrupts, campaign::Say say) {
  if (options.engine == "slurm") {
    Json table = loaded.table;
    table["folder"] = loaded.folder;
    return std::make_unique<campaign::SlurmEngine>(fs::absolute(options.out).string() + kSlurmFolder, table,
                                                   loaded.rows, interrupts, std::move(say));
  }
  return std::make_unique<campaign::LocalEngine>(loaded.rows, jobs, interrupts, std::move(say));
}

}  // namespace

int campaign_command(const CampaignOptions& given) {
  CampaignOptions options = given;
  LoadedCampaign loaded = load(options.file);
  campaign::Rows& rows = loaded.rows;
  check_keys(rows.config());
  std::vector<std::uint64_t> numbers(rows.count());
  for (std::uint64_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
  if (!options.rows.empty()) numbers = parse_rows(options.rows, rows.count());
  const bool is_asked_for = !options.full.empty() || !options.results.empty();
  if (is_asked_for && options.rows.empty()) throw BadInput("--rows: not given; say which rows, e.g. --rows 3,7-9");
  if (!options.rows.empty() && !is_asked_for)
    throw BadInput("--rows: goes with --full DIR or --results DIR; give one of them, or leave it out");
  launcher::InterruptGuard interrupts;
  std::unique_ptr<campaign::Progress> progress;
  if (options.out.empty()) options.out = rows.config().name + ".db";
  const campaign::Say say = [&](const std::string& text) { progress->say(text); };
  check_rows(options, rows, numbers, {});
  const std::size_t jobs = jobs_of(options);
  if (is_asked_for) {
    progress = std::make_unique<campaign::Progress>(numbers.size());
    return run_rows(options, *engine_of(options, jobs, loaded, interrupts, say), *progress, interrupts, numbers);
  }
  bool is_repeatable = true;
  {
    campaign::Store store(options.out, {rows.config().name, loaded.table, programs_hash(), rows.count()});
    const std::map<std::uint64_t, std::string> done = store.done();
    if (!done.empty()) check_rows(options, rows, numbers, done);
    if (done.empty()) fs::remove_all(options.out + kSlurmFolder);  // of a database that was removed
    const auto engine = engine_of(options, jobs, loaded, interrupts, say);
    std::erase_if(numbers, [&](std::uint64_t number) { return done.count(number) != 0; });
    progress = std::make_unique<campaign::Progress>(numbers.size());
    progress->say("campaign " + rows.config().name + ": " + std::to_string(rows.count()) + " rows, " +
                  std::to_string(done.size()) + " of them done, to " + options.out);
    engine->run({numbers, ""}, [&](const RowResult& result) {
      const Row row = rows.at(result.number);
      store.put(row, command_of(options, row), result);
      progress->row_done(result.outcome == "success");
    });
    if (interrupts.count() == 0) repeat_failed(options, rows, store, *engine, *progress, is_repeatable);
    store.finish();
  }
  if (interrupts.count() > 0)
    throw launcher::Interrupted("campaign: interrupted; what is done is in " + options.out +
                                ", and the same command goes on with the rest");
  progress.reset();
  return say_end(options, rows.count(), is_repeatable);
}

}  // namespace liana::cli
