// Whether the archive of a run is as it was written, and what it holds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "host/storage/archive/ring_reader.hpp"
#include "host/storage/archive/rows.hpp"

namespace liana::archive {

// Of one life.
struct LifeCheck {
  std::uint64_t number = 0;
  bool finished = false;
  double period_s = 0.0;            // of the ticks
  double from_s = 0.0, to_s = 0.0;  // of telemetry, arm time
  std::uint64_t events = 0, commands = 0, refused = 0, records = 0;
  std::vector<Gap> gaps;
  RingCheck ring;  // its ticks, at control rate
};

struct Check {
  std::vector<std::string> problems;  // empty: every file is there and whole, and every row can be read
  std::vector<LifeCheck> lives;
  std::uint64_t bytes = 0;  // of all files
};

// Reads all of it: of 24 hours a second, and a minute for their ring. `folder`: that of a run. Throws
// std::runtime_error where there is no archive.
Check check(const std::string& folder);

}  // namespace liana::archive
