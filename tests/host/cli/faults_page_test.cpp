// docs/faults.md is for operators; it must say what the core says.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "firmware_like/safety/faults.hpp"

namespace liana {
namespace {

const char* category_name(StopCategory category) {
  constexpr const char* kNames[] = {"none", "hold", "stop", "off"};
  return kNames[static_cast<std::size_t>(category)];
}

TEST(FaultsPage, HasARowWithMeaningAndRemedyForEveryFault) {
  std::ifstream file(LIANA_DOCS_DIR "/faults.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  ASSERT_GT(all_faults().size(), 1u);
  for (const FaultInfo& fault : all_faults().subspan(1)) {
    const std::string row = "| " + std::to_string(static_cast<int>(fault.number)) + " | " + fault.name + " | " +
                            category_name(fault.category) + (fault.immediate ? " at once" : "") + " | " + fault.text + " | " +
                            fault.remedy + " |\n";
    EXPECT_NE(page.find(row), std::string::npos) << "docs/faults.md lacks: " << row;
  }
}

}  // namespace
}  // namespace liana
