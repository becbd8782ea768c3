// Who carries out rows: this computer, or a cluster (slurm.hpp).
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "host/apps/campaign/result.hpp"
#include "host/apps/campaign/rows.hpp"
#include "host/apps/launcher/interrupt.hpp"

namespace liana::campaign {

// Runs a program of PATH, and sets its variables and folder.
inline constexpr const char* kEnv = "/usr/bin/env";

// What rows are to be carried out, and how.
struct Order {
  std::vector<std::uint64_t> rows;
  std::string full_folder;  // empty: lean; else each row keeps everything in a folder there, row-NNNNNN
};

using TakeResult = std::function<void(const RowResult&)>;
using Say = std::function<void(const std::string&)>;  // a line for people

class Engine {
 public:
  virtual ~Engine() = default;
  // Carries out the rows in any order, and gives each result as soon as it is there. A row may come without one: when
  // its run was killed again and again, or after an interrupt. Throws std::runtime_error when nothing can be started.
  virtual void run(const Order& order, const TakeResult& take) = 0;
};

// Runs `jobs` rows at a time as programs of this computer, in a temporary folder that is gone afterwards.
class LocalEngine : public Engine {
 public:
  LocalEngine(Rows& rows, std::size_t jobs, const launcher::InterruptGuard& interrupts, Say say)
      : rows_(rows), jobs_(jobs), interrupts_(interrupts), say_(std::move(say)) {}
  void run(const Order& order, const TakeResult& take) override;

 private:
  Rows& rows_;
  std::size_t jobs_;
  const launcher::InterruptGuard& interrupts_;
  Say say_;
};

// Processors that this process may use.
std::size_t processors();

// Folder of a row that keeps everything.
std::string folder_of_row(const std::string& full_folder, std::uint64_t number);

}  // namespace liana::campaign
