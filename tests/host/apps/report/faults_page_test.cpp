// docs/reference/faults.md is for operators; its table is what `liana faults --markdown` prints.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "host/apps/launcher/tables.hpp"
#include "host/apps/report/fault_table.hpp"

namespace liana::report {
namespace {

FaultTimes shipped() {
  const cable::RobotParams table = launcher::robot_for_kinematics("zhu2022").table;
  return {table.tick_s, table.segment_count};
}

TEST(FaultsPage, HoldsTheTableThatTheCodePrints) {
  std::ifstream file(LIANA_DOCS_DIR "/reference/faults.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string table = markdown_of(fault_rows(shipped()));
  EXPECT_NE(page.find("\n\n" + table + "\n"), std::string::npos) << "put this into docs/reference/faults.md:\n"
                                                                 << table;
}

TEST(FaultsPage, EveryNumberSaysHowItIsDetectedAndWhatItStops) {
  const std::vector<FaultRow> rows = fault_rows(shipped());
  ASSERT_EQ(rows.size(), all_faults().size() - 1);
  for (const FaultRow& row : rows) {
    EXPECT_STRNE(row.detector, "") << row.info.name;
    EXPECT_NE(row.stops_by, "none") << row.info.name;
  }
}

TEST(FaultsPage, ASerialArmHasNoTimesForFaultsOfCables) {
  for (const FaultRow& row : fault_rows({0.004, 0})) {
    const int number = static_cast<int>(row.info.number);
    if (number / 1000 == 5) {
      EXPECT_EQ(row.within_ticks, -1) << row.info.name;
    } else if (number / 1000 == 3) {
      EXPECT_GE(row.within_ticks, 0) << row.info.name;
    }
  }
}

}  // namespace
}  // namespace liana::report
