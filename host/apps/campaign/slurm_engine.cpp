#include "host/apps/campaign/slurm_engine.hpp"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <thread>
#include <utility>

#include "host/apps/launcher/errors.hpp"
#include "host/apps/launcher/output.hpp"
#include "host/apps/launcher/process.hpp"
#include "host/base/file/in_file.hpp"

namespace liana::campaign {
namespace {

namespace fs = std::filesystem;
using launcher::Captured;

constexpr int kMaxIdleRounds = 3;          // arrays in a row that have delivered nothing
constexpr int kLooksPerAsk = 8;            // squeue is asked every two seconds
constexpr const char* kPatience_s = "60";  // with programs of Slurm
constexpr int kTimedOut = 124;             // exit code of timeout
constexpr int kLooksAfter = 8;             // results of the last task may come late through a network file system

// The words of a program that is looked up on PATH; one that hangs is ended.
Captured ask(std::vector<std::string> words) {
  words.insert(words.begin(), {kEnv, "timeout", "--foreground", "--kill-after=5", kPatience_s});
  Captured said = launcher::run_and_capture(words);
  if (said.code == kTimedOut) said.error = "no answer within " + std::string(kPatience_s) + " s";
  return said;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string how_it_ended(const Captured& said) {
  return "ended with code " + std::to_string(said.code) + ": " + first_line(said.error);
}

std::string quoted(const std::string& path) { return shell_line({path}); }

}  // namespace

std::vector<std::vector<std::uint64_t>> tasks_of(const std::vector<std::uint64_t>& rows) {
  const std::size_t count = std::min(rows.size(), kMaxArrayTasks);
  std::vector<std::vector<std::uint64_t>> tasks(count);
  for (std::size_t i = 0; i < rows.size(); ++i) tasks[i % count].push_back(rows[i]);
  return tasks;
}

SlurmEngine::SlurmEngine(std::string folder, const Json& table, Rows& rows, const launcher::InterruptGuard& interrupts,
                         Say say, std::chrono::milliseconds look)
    : folder_(std::move(folder)), rows_(rows), interrupts_(interrupts), say_(std::move(say)), look_(look) {
  for (const char* below : {"/results", "/logs", "/rows"}) fs::create_directories(folder_ + below);
  launcher::write_output(folder_ + "/campaign.json", table.dump() + "\n");
  std::ifstream job(folder_ + "/job");
  std::getline(job, job_);
}

void SlurmEngine::take_results(std::set<std::uint64_t>& missing, const TakeResult& take) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_ + "/results")) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  for (const fs::path& path : files) {
    const Json found = Json::parse_or_null(file::content_of(path).value_or(""));
    std::error_code error;
    try {
      const RowResult result = row_result(found);
      const bool is_ours =
          missing.count(result.number) != 0 && rows_.at(result.number).config_hash == result.config_hash;
      if (is_ours) take(result);
      if (is_ours) missing.erase(result.number);
    } catch (const JsonError& problem) {
      say_(path.string() + ": is no result and is removed: " + problem.what());
    }
    fs::remove(path, error);
  }
}

void SlurmEngine::submit(const std::set<std::uint64_t>& missing, const std::string& full_folder) {
  launcher::write_output(folder_ + "/task.sh",
                         "#!/bin/sh\n# One task of an array: the rows that its line of the file $1 names.\n"
                         "rows=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" \"$1\")\nshift\nexec " +
                             quoted(launcher::sibling_program("liana")) + " campaign " +
                             quoted(folder_ + "/campaign.json") + " --rows \"$rows\" --results " +
                             quoted(folder_ + "/results") + " --jobs \"${SLURM_CPUS_PER_TASK:-1}\" \"$@\"\n");
  std::string lines;
  const auto tasks = tasks_of({missing.begin(), missing.end()});
  for (const std::vector<std::uint64_t>& task : tasks) {
    std::string line;
    for (const std::uint64_t row : task) line += (line.empty() ? "" : ",") + std::to_string(row);
    lines += line + "\n";
  }
  int number = 0;
  std::string rows_file;
  do {
    rows_file = folder_ + "/rows/" + std::to_string(++number) + ".txt";
  } while (fs::exists(rows_file));
  launcher::write_output(rows_file, lines);
  std::vector<std::string> words{"sbatch",
                                 "--parsable",
                                 "--no-requeue",
                                 "--job-name=liana-campaign",
                                 "--array=0-" + std::to_string(tasks.size() - 1),
                                 "--output=" + folder_ + "/logs/%A_%a.txt",
                                 folder_ + "/task.sh",
                                 rows_file};
  if (!full_folder.empty()) words.push_back("--full=" + full_folder);
  const Captured said = ask(words);
  if (said.code != 0)
    throw std::runtime_error("sbatch: " + how_it_ended(said) +
                             "; check that this computer submits jobs of Slurm (sinfo), or take --engine local");
  job_ = first_line(said.out);
  job_ = job_.substr(0, job_.find(';'));  // what follows is the cluster's name
  launcher::write_output(folder_ + "/job", job_ + "\n");
  say_("Slurm job " + job_ + ": " + std::to_string(missing.size()) + " rows in " + std::to_string(tasks.size()) +
       " tasks; logs in " + folder_ + "/logs");
}

// Also where Slurm does not answer: a job that may be there is waited for, as long as an outage takes.
bool SlurmEngine::is_queued() {
  const Captured said = ask({"squeue", "--noheader", "--array", "--format=%F", "--user=" + std::to_string(geteuid())});
  unanswered_ = said.code == 0 ? 0 : unanswered_ + 1;
  if (unanswered_ == kSayUnanswered)
    say_("squeue " + how_it_ended(said) + "; job " + job_ + " is waited for, and squeue asked again");
  if (unanswered_ >= kMaxUnanswered)
    throw std::runtime_error("squeue: failed " + std::to_string(unanswered_) + " times in a row, and job " + job_ +
                             " delivered nothing meanwhile: it " + how_it_ended(said) +
                             "; wait until Slurm answers again (squeue), then give the same command");
  if (said.code != 0) return true;
  std::istringstream lines(said.out);
  for (std::string job; lines >> job;) {
    if (job == job_) return true;
  }
  return false;
}

void SlurmEngine::wait(std::set<std::uint64_t>& missing, const TakeResult& take) {
  int looks_after = 0;
  for (int look = 1; !missing.empty() && looks_after <= kLooksAfter && interrupts_.count() == 0; ++look) {
    std::this_thread::sleep_for(look_);
    const std::size_t before = missing.size();
    take_results(missing, take);
    if (missing.size() < before) unanswered_ = 0;
    if (looks_after > 0) {
      ++looks_after;
    } else if (look % kLooksPerAsk == 0 && !is_queued()) {
      looks_after = 1;
    }
  }
}

void SlurmEngine::run(const Order& order, const TakeResult& take) {
  std::set<std::uint64_t> missing(order.rows.begin(), order.rows.end());
  take_results(missing, take);
  for (int idle = 0; !missing.empty() && interrupts_.count() == 0;) {
    const std::size_t before = missing.size();
    if (job_.empty()) submit(missing, order.full_folder);
    wait(missing, take);
    if (interrupts_.count() > 0) break;
    job_.clear();
    fs::remove(folder_ + "/job");
    idle = missing.size() < before ? 0 : idle + 1;
    if (idle >= kMaxIdleRounds) {
      say_(std::to_string(missing.size()) + " rows are missing after " + std::to_string(idle) +
           " arrays that delivered nothing; see " + folder_ + "/logs");
      return;
    }
  }
  if (interrupts_.count() > 0 && !job_.empty()) {
    ask({"scancel", job_});
    fs::remove(folder_ + "/job");
  }
}

}  // namespace liana::campaign
