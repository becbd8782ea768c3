// What is sent over a delayed link comes out late and as it went in (req:A12).
#include "host/operator/station/delay_line.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace liana::station {
namespace {

TEST(DelayLine, DeliversAfterItsDelayAndNotBefore) {
  DelayLine<std::string> line({0.5, 0.0, 0.0}, 1, 1);
  line.send("go", 1000000);
  EXPECT_FALSE(line.receive(1499999));
  const auto come = line.receive(1500000);
  ASSERT_TRUE(come);
  EXPECT_EQ(*come->load, "go");
  EXPECT_TRUE(come->is_newest);
  EXPECT_FALSE(line.receive(9000000));
}

TEST(DelayLine, WithoutDelayDeliversAtOnce) {
  DelayLine<int> line({0.0, 0.05, 0.0}, 1, 1);
  for (int k = 0; k < 100; ++k) {
    line.send(k, 20000 * k);
    const auto come = line.receive(20000 * k);
    ASSERT_TRUE(come);
    EXPECT_EQ(*come->load, k);
  }
}

TEST(DelayLine, MarksWhatALaterOneHasOvertakenAndLosesNothing) {
  DelayLine<int> line({0.5, 0.2, 0.0}, 7, 1);
  std::set<int> come;
  int newest = -1, overtaken = 0;
  for (int k = 0; k < 400; ++k) {
    if (k < 300) line.send(k, 20000 * k);
    while (const auto arrival = line.receive(20000 * k)) {
      come.insert(*arrival->load);
      EXPECT_EQ(arrival->is_newest, *arrival->load > newest);
      overtaken += arrival->is_newest ? 0 : 1;
      newest = std::max(newest, *arrival->load);
    }
  }
  EXPECT_EQ(come.size(), 300u);
  EXPECT_GT(overtaken, 10);
}

}  // namespace
}  // namespace liana::station
