// The times at which a page has numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace liana::run_page {

struct TimeGrid {
  std::uint64_t first = 0;  // tick
  std::uint64_t every = 1;  // ticks from row to row
  std::size_t rows = 0;
  std::uint64_t tick(std::size_t row) const { return first + every * row; }
};

// From the first record to the last; 25 rows a second of arm time, fewer where that were more than 30 000.
TimeGrid grid_of(const std::vector<std::string>& records, double period_s);

// For each row the newest record that is no older than two rows, or nullptr.
std::vector<const std::string*> records_at(const TimeGrid& grid, const std::vector<std::string>& records);

}  // namespace liana::run_page
