#include "host/control/visual_servo/tip_history.hpp"

#include <gtest/gtest.h>

namespace liana::visual_servo {
namespace {

Pose at_x(double x) { return {{x, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}; }

TEST(TipHistory, BetweenTwoNotesTheTipWentStraight) {
  TipHistory history;
  history.note(1.0, at_x(0.0));
  history.note(1.02, at_x(0.2));
  ASSERT_TRUE(history.at(1.015));
  EXPECT_NEAR(history.at(1.015)->position_m[0], 0.15, 1e-12);
  EXPECT_NEAR(history.at(1.02)->position_m[0], 0.2, 1e-12);
}

TEST(TipHistory, KnowsNothingOfTheFutureNorOfWhatItHasForgotten) {
  TipHistory history;
  EXPECT_FALSE(history.at(0.0));
  for (int i = 0; i < 300; ++i) history.note(0.02 * i, at_x(i));
  EXPECT_FALSE(history.at(0.02 * 300));
  EXPECT_FALSE(history.at(0.02 * 43));
  EXPECT_TRUE(history.at(0.02 * 44));
}

TEST(TipHistory, BeginsAnewWhenTimeGoesBack) {
  TipHistory history;
  history.note(5.0, at_x(5.0));
  history.note(1.0, at_x(1.0));
  EXPECT_FALSE(history.at(0.9));
  EXPECT_EQ(history.at(1.0)->position_m[0], 1.0);
  EXPECT_FALSE(history.at(5.0));
}

}  // namespace
}  // namespace liana::visual_servo
