// The times at which a page has numbers.
#include "host/apps/run_page/time_grid.hpp"

#include <gtest/gtest.h>

#include <cstring>

#include "host/api/telemetry/record.hpp"

namespace liana::run_page {
namespace {

std::string record_at(double tick) {
  std::string record(telemetry::kHeaderBytes, '\0');
  std::memcpy(record.data() + 8, &tick, sizeof tick);
  return record;
}

TEST(TimeGrid, HasTwentyFiveRowsASecondFromFirstToLastRecord) {
  std::vector<std::string> records;
  for (int i = 0; i <= 100; ++i) records.push_back(record_at(105 + 5 * i));
  const TimeGrid grid = grid_of(records, 0.004);
  EXPECT_EQ(grid.first, 105u);
  EXPECT_EQ(grid.every, 10u);
  EXPECT_EQ(grid.rows, 51u);
  EXPECT_EQ(records_at(grid, records)[50], &records[100]);
}

// req:A25
TEST(TimeGrid, HasFewerRowsForADay) {
  const TimeGrid grid = grid_of({record_at(0), record_at(21600000)}, 0.004);
  EXPECT_LE(grid.rows, 30001u);
  EXPECT_GE(grid.rows, 20000u);
}

TEST(TimeGrid, HasNothingWhereRecordsAreMissing) {
  const std::vector<std::string> records{record_at(0), record_at(10), record_at(60), record_at(70)};
  const TimeGrid grid = grid_of(records, 0.004);
  const auto rows = records_at(grid, records);
  ASSERT_EQ(rows.size(), 8u);
  EXPECT_EQ(rows[1], &records[1]);
  EXPECT_EQ(rows[2], &records[1]);  // one row old
  EXPECT_EQ(rows[3], nullptr);
  EXPECT_EQ(rows[5], nullptr);
  EXPECT_EQ(rows[6], &records[2]);
}

TEST(TimeGrid, IsEmptyWithoutRecords) { EXPECT_EQ(grid_of({}, 0.004).rows, 0u); }

}  // namespace
}  // namespace liana::run_page
