// Rows on a cluster: job arrays of Slurm, whose tasks write each result as a file into a folder that all nodes see.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "host/apps/campaign/engine.hpp"

namespace liana::campaign {

constexpr std::size_t kMaxArrayTasks = 1001;  // Slurm's own default, MaxArraySize

// Lists of rows, one for each task of an array: at most kMaxArrayTasks, and as equal as can be.
std::vector<std::vector<std::uint64_t>> tasks_of(const std::vector<std::uint64_t>& rows);

// Submits what is missing, waits, takes results, and asks again for rows that lost nodes have not delivered. Options of
// sbatch come from its own environment (SBATCH_PARTITION). When it is killed its job goes on: the next one waits for
// that job and takes its results.
class SlurmEngine : public Engine {
 public:
  // `folder`: absolute, seen by all nodes; `table`: the campaign's, with the folder it was read from.
  SlurmEngine(std::string folder, const Json& table, Rows& rows, const launcher::InterruptGuard& interrupts, Say say);
  void run(const Order& order, const TakeResult& take) override;

 private:
  void take_results(std::set<std::uint64_t>& missing, const TakeResult& take);
  void submit(const std::set<std::uint64_t>& missing, const std::string& full_folder);
  bool is_queued() const;
  void wait(std::set<std::uint64_t>& missing, const TakeResult& take);

  std::string folder_;
  Rows& rows_;
  const launcher::InterruptGuard& interrupts_;
  Say say_;
  std::string job_;  // empty: none
};

}  // namespace liana::campaign
