// Every error code has one row, with a name of its own.
#include "host/control/verification/refusal_table.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

namespace liana::verification {
namespace {

// req:C8
TEST(RefusalTable, EveryCodeHasARowInTheOrderOfTheNumbers) {
  std::vector<int> codes;
  for (const RefusalRow& row : refusal_table()) codes.push_back(static_cast<int>(row.code));
  EXPECT_EQ(codes, (std::vector<int>{101, 102, 103, 104, 105, 106, 107, 108, 109, 201, 202, 203,
                                     204, 205, 206, 207, 208, 209, 210, 211, 212, 213, 214}));
}

TEST(RefusalTable, NamesAreWordsAndNoTwoAreTheSame) {
  std::set<std::string> names;
  for (const RefusalRow& row : refusal_table()) {
    EXPECT_TRUE(names.insert(row.name).second) << row.name;
    EXPECT_EQ(std::string(row.name).find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << row.name;
    EXPECT_FALSE(std::string(row.remedy).empty()) << row.name;
    EXPECT_EQ(std::string(row.says).back(), '.') << row.name;
    EXPECT_EQ(std::string(row.remedy).back(), '.') << row.name;
    EXPECT_EQ(&row_of(row.code), &row);
  }
}

TEST(RefusalTable, ACodeThatDoesNotExistHasTheRowOfNone) {
  for (const int code : {0, 100, 110, 200, 215, 65535})
    EXPECT_STREQ(row_of(static_cast<Refusal>(code)).name, "") << code;
}

// Beside a body of the scene the drives keep their power: an arm that is switched off shifts, and its way back with it.
// req:C12
TEST(RefusalTable, OnlyAnArmThatWouldTouchItselfIsStopped) {
  std::set<std::string> stops;
  for (const RefusalRow& row : refusal_table()) {
    if (row.action == RefusalAction::kStop) stops.insert(row.name);
  }
  EXPECT_EQ(stops, (std::set<std::string>{"self_contact"}));
}

TEST(RefusalTable, ThePageHoldsWhatTheCodePrints) {
  std::ifstream file(LIANA_DOCS_DIR "/reference/refusals.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  const std::string table = markdown_of(refusal_table());
  EXPECT_NE(page.find("\n\n" + table), std::string::npos) << "put this into docs/reference/refusals.md:\n" << table;
}

}  // namespace
}  // namespace liana::verification
