// Facts as what has changed in them.
#include "host/storage/archive/facts_change.hpp"

#include <gtest/gtest.h>

#include "host/base/json/json.hpp"

namespace liana::archive {
namespace {

TEST(FactsChange, HoldsOnlyMembersThatAreOther) {
  const Json before{{"state", "ENABLED"}, {"limits", Json::array()}, {"path", nullptr}};
  const Json now{{"state", "ENABLED"}, {"limits", {"theta_rate"}}, {"path", nullptr}};
  const auto change = change_of(before, now);
  ASSERT_TRUE(change);
  EXPECT_EQ(*change, Json({{"limits", {"theta_rate"}}}));
  EXPECT_EQ(with_change(before, *change), now);
}

TEST(FactsChange, TellsAMemberThatBecomesNullFromOneThatGoes) {
  const Json before{{"path", 1}, {"verdict", 2}};
  const Json null{{"path", nullptr}, {"verdict", 2}};
  ASSERT_TRUE(change_of(before, null));
  EXPECT_EQ(with_change(before, *change_of(before, null)), null);
  EXPECT_FALSE(change_of(before, Json{{"path", 1}}));
}

}  // namespace
}  // namespace liana::archive
