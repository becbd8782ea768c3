#include "host/apps/run_page/time_grid.hpp"

#include <algorithm>
#include <cmath>

#include "host/api/telemetry/record.hpp"

namespace liana::run_page {
namespace {

constexpr double kRow_s = 0.04;
constexpr std::uint64_t kMaxRows = 30000;

std::uint64_t tick_of(const std::string& record) {
  return static_cast<std::uint64_t>(telemetry::header_of(record).tick);
}

}  // namespace

TimeGrid grid_of(const std::vector<std::string>& records, double period_s) {
  if (records.empty()) return {};
  TimeGrid grid{tick_of(records.front()), 1, 0};
  const std::uint64_t span = tick_of(records.back()) - grid.first;
  grid.every =
      std::max({std::uint64_t{1}, static_cast<std::uint64_t>(std::lround(kRow_s / period_s)), span / kMaxRows + 1});
  grid.rows = static_cast<std::size_t>(span / grid.every) + 1;
  return grid;
}

std::vector<const std::string*> records_at(const TimeGrid& grid, const std::vector<std::string>& records) {
  std::vector<const std::string*> found;
  std::size_t next = 0;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    const std::uint64_t tick = grid.tick(row);
    while (next < records.size() && tick_of(records[next]) <= tick) ++next;
    const bool is_new = next > 0 && tick_of(records[next - 1]) + 2 * grid.every > tick;
    found.push_back(is_new ? &records[next - 1] : nullptr);
  }
  return found;
}

}  // namespace liana::run_page
