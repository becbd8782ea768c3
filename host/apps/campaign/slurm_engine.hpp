// Rows on a cluster: job arrays of Slurm, whose tasks write each result as a file into a folder that all nodes see.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/apps/campaign/engine.hpp"

namespace liana::campaign {

constexpr std::size_t kMaxArrayTasks = 1001;  // Slurm's own default, MaxArraySize
constexpr auto kLookForResults = std::chrono::milliseconds(250);
// Failures of squeue in a row, while nothing is delivered: then people are told, and then the campaign ends.
constexpr int kSayUnanswered = 15;   // about 30 s
constexpr int kMaxUnanswered = 900;  // about half an hour

// Lists of rows, one for each task of an array: at most kMaxArrayTasks, and as equal as can be.
std::vector<std::vector<std::uint64_t>> tasks_of(const std::vector<std::uint64_t>& rows);

// Submits what is missing, waits, takes results, and asks again for rows that lost nodes have not delivered. Options of
// sbatch come from its own environment (SBATCH_PARTITION). When it is killed its job goes on: the next one waits for
// that job and takes its results.
class SlurmEngine : public Engine {
 public:
  // `folder`: absolute, seen by all nodes; `table`: the campaign's, with the folder it was read from; `look`: time
  // between two looks for results.
  SlurmEngine(std::string folder, const Json& table, Rows& rows, const launcher::InterruptGuard& interrupts, Say say,
              std::chrono::milliseconds look = kLookForResults);
  // Throws std::runtime_error also when squeue has failed kMaxUnanswered times.
  void run(const Order& order, const TakeResult& take) override;

 private:
  void take_results(std::set<std::uint64_t>& missing, const TakeResult& take);
  void submit(const std::set<std::uint64_t>& missing, const std::string& full_folder);
  bool is_queued();
  void wait(std::set<std::uint64_t>& missing, const TakeResult& take);

  std::string folder_;
  Rows& rows_;
  const launcher::InterruptGuard& interrupts_;
  Say say_;
  std::chrono::milliseconds look_;
  std::string job_;  // empty: none
  int unanswered_ = 0;
};

}  // namespace liana::campaign
