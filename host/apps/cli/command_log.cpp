#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "host/apps/cli/commands.hpp"
#include "host/apps/cli/run_choice.hpp"
#include "host/apps/launcher/errors.hpp"
#include "host/apps/report/command_json.hpp"
#include "host/base/file/in_file.hpp"
#include "host/base/json/json.hpp"
#include "host/control/verification/refusal_table.hpp"

namespace liana::cli {
namespace {

namespace fs = std::filesystem;
using event::Dispatch;
using report::CommandRecord;

constexpr const char* kCommandsFile = "commands.txt";

// The file of the run that is named, of the newest run when none is.
fs::path file_of(const std::string& run) {
  const fs::path found = run.empty() ? newest_run_with("commands", kCommandsFile) : named_run("commands", run);
  const fs::path path = fs::is_directory(found) ? found / kCommandsFile : found;
  if (fs::exists(path)) return path;
  throw launcher::BadInput("commands: '" + found.string() + "': holds no " + kCommandsFile +
                           "; give another run (liana log list), or a commands.txt");
}

std::string outcome(const CommandRecord& life) {
  if (life.refusal && !life.is_command()) return life.refusal->text;
  if (life.refusal) {
    const verification::RefusalRow& row =
        verification::row_of(static_cast<verification::Refusal>(life.refusal->number));
    return "refused: " + life.refusal->text + " [" + std::to_string(life.refusal->number) + " " + row.name + "]";
  }
  return life.complete ? "complete" : life.start ? "started" : life.release ? "released" : "asked for";
}

std::string share_text(const std::optional<Dispatch>& verdict) {
  if (!verdict) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", verdict->share);
  return text;
}

void print(const CommandRecord& life) {
  std::printf("%8llu %9llu  %-12s %-8s %9s %10s  %s\n", static_cast<unsigned long long>(life.command),
              static_cast<unsigned long long>(life.tick), life.owner.c_str(), report::command_kind_name(life),
              share_text(life.execution).c_str(), share_text(life.simulation).c_str(), outcome(life).c_str());
}

// Least of a figure over all commands, its median, and the command of the least.
Json margin_json(const std::vector<CommandRecord>& lives, std::size_t which) {
  std::vector<std::pair<double, std::uint64_t>> found;
  for (const CommandRecord& life : lives) {
    if (!life.simulation || !life.simulation->margins) continue;
    const double margin = (*life.simulation->margins)[which];
    if (std::isfinite(margin)) found.emplace_back(margin, life.command);
  }
  if (found.empty()) return nullptr;
  std::sort(found.begin(), found.end());
  return {{"least", found.front().first},
          {"median", found[(found.size() - 1) / 2].first},
          {"command", found.front().second},
          {"commands", found.size()}};
}

void print_margins(const std::vector<CommandRecord>& lives, bool json) {
  Json all = Json::object();
  for (std::size_t i = 0; i < event::kMargins; ++i) all[event::kMarginNames[i]] = margin_json(lives, i);
  if (json) {
    std::puts(all.dump().c_str());
    return;
  }
  std::printf("%-12s %12s %12s  %s\n", "left of", "least", "median", "least in command");
  for (const auto& [name, margin] : all.items()) {
    if (margin.is_null()) continue;
    std::printf("%-12s %12.4g %12.4g  %llu of %llu\n", name.c_str(), margin["least"].get<double>(),
                margin["median"].get<double>(), static_cast<unsigned long long>(margin["command"].get<std::uint64_t>()),
                static_cast<unsigned long long>(margin["commands"].get<std::uint64_t>()));
  }
}

}  // namespace

int command_log(const CommandsOptions& options) {
  const fs::path path = file_of(options.run);
  file::require_ordinary(path.string());
  std::ifstream in(path);
  std::size_t unread = 0;
  std::vector<CommandRecord> lives = report::command_lives(in, unread);
  if (unread > 0 && lives.empty())
    throw launcher::BadInput("commands: '" + path.string() + "': none of its " + std::to_string(unread) +
                             " lines is a stage of a command; give a run (liana log list), or its " + kCommandsFile);
  if (unread > 0) std::fprintf(stderr, "liana: %s: %zu lines are no stages of commands\n", path.c_str(), unread);
  if (options.margins) {
    print_margins(lives, options.json);
    return launcher::kExitOk;
  }
  if (options.refused) std::erase_if(lives, [](const CommandRecord& life) { return !life.is_refused(); });
  const auto count = std::min<std::size_t>(lives.size(), options.last);
  if (!options.json && count > 0)
    std::printf("%8s %9s  %-12s %-8s %9s %10s  %s\n", "command", "tick", "owner", "kind", "execution", "simulation",
                "outcome (shares are of the limit that the motion comes nearest to)");
  for (std::size_t i = lives.size() - count; i < lives.size(); ++i) {
    if (options.json) {
      std::puts(report::command_json(lives[i]).dump(-1, Json::BadUtf8::kReplace).c_str());
    } else {
      print(lives[i]);
    }
  }
  return launcher::kExitOk;
}

}  // namespace liana::cli
