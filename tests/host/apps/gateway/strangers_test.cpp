// Places and time of connections that have not said hello.
#include "host/apps/gateway/strangers.hpp"

#include <gtest/gtest.h>

#include <array>

namespace liana::gateway {
namespace {

class StrangersTest : public testing::Test {
 protected:
  std::optional<Strangers::Id> come(std::size_t who, const std::string& address, double now_s = 0.0) {
    return strangers_.come(&place_[who], address, now_s);
  }
  std::array<char, 300> place_{};
  Strangers strangers_;
};

TEST_F(StrangersTest, WhoFillsAllPlacesLosesHisOwnOldest) {
  EXPECT_FALSE(come(0, "honest"));
  for (std::size_t i = 1; i < Strangers::kMost; ++i) EXPECT_FALSE(come(i, "flood")) << i;
  EXPECT_EQ(come(200, "flood"), &place_[1]);
  EXPECT_EQ(come(201, "another"), &place_[2]);
  EXPECT_EQ(strangers_.count(), Strangers::kMost);
}

TEST_F(StrangersTest, TimeIsCountedFromTheBeginWhateverIsSaidMeanwhile) {
  come(0, "a", 100.0);
  come(1, "b", 101.0);
  strangers_.asked(&place_[1]);
  EXPECT_TRUE(strangers_.overdue(100.0 + Strangers::kRequest_s).empty());
  const std::vector<Strangers::Id> first{&place_[0]}, both{&place_[0], &place_[1]};
  EXPECT_EQ(strangers_.overdue(102.0 + Strangers::kRequest_s), first);
  strangers_.asked(&place_[1]);
  EXPECT_EQ(strangers_.overdue(102.0 + Strangers::kHello_s), both);
  strangers_.leave(&place_[0]);
  strangers_.leave(&place_[1]);
  EXPECT_TRUE(strangers_.overdue(1e6).empty());
}

}  // namespace
}  // namespace liana::gateway
