// docs/faults.md is for operators; its table is what `liana faults --markdown` prints.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "host/report/fault_table.hpp"
#include "host/system/tables.hpp"

namespace liana::report {
namespace {

TEST(FaultsPage, HoldsTheTableThatTheCodePrints) {
  std::ifstream file(LIANA_DOCS_DIR "/faults.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string table = markdown_of(fault_rows(system::robot_for_kinematics("zhu2022").table));
  EXPECT_NE(page.find("\n\n" + table + "\n"), std::string::npos) << "put this into docs/faults.md:\n" << table;
}

TEST(FaultsPage, EveryNumberSaysHowItIsDetectedAndWhatItStops) {
  const std::vector<FaultRow> rows = fault_rows(system::robot_for_kinematics("zhu2022").table);
  ASSERT_EQ(rows.size(), all_faults().size() - 1);
  for (const FaultRow& row : rows) {
    EXPECT_STRNE(row.detector, "") << row.info.name;
    EXPECT_NE(row.stops_by, "none") << row.info.name;
  }
}

}  // namespace
}  // namespace liana::report
