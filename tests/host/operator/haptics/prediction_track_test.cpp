// The ring of predictions: every time that an answer may ask for.
#include "host/operator/haptics/prediction_track.hpp"

#include <gtest/gtest.h>

namespace liana::haptics {
namespace {

Motion at_x(double x_m) { return {{x_m, 0.0, 0.0}, {2.0 * x_m, 0.0, 0.0}}; }

TEST(PredictionTrack, IsStraightBetweenTwoAndEndsWhereItEnds) {
  PredictionTrack track;
  EXPECT_FALSE(track.newest());
  EXPECT_FALSE(track.at(0));
  track.put(20000, at_x(0.1));
  track.put(40000, at_x(0.3));
  struct Row {
    std::int64_t t_us;
    double x_m;
  };
  for (const Row& row : {Row{20000, 0.1}, Row{25000, 0.15}, Row{40000, 0.3}, Row{90000, 0.3}}) {
    ASSERT_TRUE(track.at(row.t_us));
    EXPECT_NEAR(track.at(row.t_us)->position_m[0], row.x_m, 1e-12) << row.t_us;
    EXPECT_NEAR(track.at(row.t_us)->velocity_m_s[0], 2.0 * row.x_m, 1e-12) << row.t_us;
  }
  EXPECT_FALSE(track.at(19999));
}

TEST(PredictionTrack, KeepsTenSecondsAndIgnoresTimesThatDoNotRise) {
  PredictionTrack track;
  for (int i = 0; i < 2000; ++i) {
    track.put(20000 * i, at_x(0.001 * i));
    track.put(20000 * i, at_x(9.0));
    track.put(20000 * (i - 1), at_x(9.0));
  }
  EXPECT_EQ(track.newest()->position_m[0], 1.999);
  EXPECT_NEAR(track.at(20000 * (1999 - 500) + 10000)->position_m[0], 1.4995, 1e-12);
  EXPECT_FALSE(track.at(20000 * (1999 - 512)));
}

}  // namespace
}  // namespace liana::haptics
