// What is written of the dictionary for people is what the docs have.
#include "host/api/ground/definitions.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace liana::ground {
namespace {

constexpr Sizes kRobotSizes{10, 15};

std::size_t count_of(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(GroundPage, IsTheOneOfTheDocs) {
  std::ifstream in(std::string(LIANA_SOURCE_DIR) + "/docs/reference/ground-packets.md", std::ios::binary);
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(page, ground_page(kRobotSizes)) << "run ./dev docs";
}

TEST(Definitions, OfXtceHaveAContainerForEachPacket) {
  const std::string text = xtce(kRobotSizes);
  EXPECT_EQ(count_of(text, "<SequenceContainer "), reports().size() + 3);
  EXPECT_EQ(count_of(text, "<MetaCommand "), commands().size() + 1);
}

TEST(Definitions, OfCosmosHaveAnEntryForEachPacket) {
  const std::string text = cosmos(kRobotSizes);
  EXPECT_EQ(count_of(text, "TELEMETRY LIANA "), reports().size());
  EXPECT_EQ(count_of(text, "COMMAND LIANA "), commands().size());
}

TEST(Definitions, AreAsLongAsTheRobotsLists) {
  EXPECT_EQ(count_of(xtce({7, 0}), "joints_setpoint_js_deg_"), 2u * 7);
  EXPECT_EQ(count_of(xtce({7, 0}), "tension_N_"), 0u);
}

}  // namespace
}  // namespace liana::ground
