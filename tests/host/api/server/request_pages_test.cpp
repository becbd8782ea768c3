// What is made of the table of requests stands in the tree as the table says it now.
#include "host/api/server/request_pages.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace liana::api {
namespace {

class RequestPages : public testing::TestWithParam<MadeSection> {};

TEST_P(RequestPages, TheTreeHoldsWhatTheTableSays) {
  std::ifstream file(std::string(LIANA_SOURCE_DIR "/") + GetParam().file);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(section_of(GetParam(), text), GetParam().make()) << "run ./dev docs";
}

INSTANTIATE_TEST_SUITE_P(Made, RequestPages, testing::Values(kRequestSection, kCommandStubs));

TEST(RequestPagesText, AFileWithoutItsLinesIsRefusedAndTheRestOfOneIsKept) {
  const MadeSection section{"page.md", "<begin>\n", "<end>\n", request_section};
  EXPECT_EQ(with_section(section, "a\n<begin>\nold\n<end>\nz\n", "new\n"), "a\n<begin>\nnew\n<end>\nz\n");
  EXPECT_THROW(with_section(section, "a\n<end>\n<begin>\nz\n", "new\n"), std::runtime_error);
}

}  // namespace
}  // namespace liana::api
