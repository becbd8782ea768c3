#include "host/base/svg/axes.hpp"

#include <gtest/gtest.h>

namespace liana::svg {
namespace {

TEST(Axes, PutTheEndsOfTheRangesOnTheEdges) {
  const Axes axes{{100.0, 50.0}, 200.0, 80.0, {-1.0, 3.0}, {0.0, 4.0}};
  EXPECT_DOUBLE_EQ(axes.at(-1.0, 0.0).x, 100.0);
  EXPECT_DOUBLE_EQ(axes.at(-1.0, 0.0).y, 130.0);
  EXPECT_DOUBLE_EQ(axes.at(3.0, 4.0).x, 300.0);
  EXPECT_DOUBLE_EQ(axes.at(3.0, 4.0).y, 50.0);
}

TEST(Axes, LogarithmicHeightsAreEvenInRatios) {
  const Axes axes{{0.0, 0.0}, 1.0, 90.0, {0.0, 1.0}, {1.0, 1000.0}, true};
  EXPECT_NEAR(axes.at(0.0, 10.0).y, 60.0, 1e-9);
  EXPECT_NEAR(axes.at(0.0, 100.0).y, 30.0, 1e-9);
}

TEST(Ticks, StandAtRoundPlacesInsideTheRange) {
  EXPECT_EQ(ticks({0.0, 10.0}, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(ticks({-3.6, 4.2}, 8), (std::vector<double>{-3, -2, -1, 0, 1, 2, 3, 4}));
  for (const double width : {1e-3, 0.7, 13.0, 4e5}) {
    const auto places = ticks({0.1 * width, 1.1 * width}, 6);
    EXPECT_GE(places.size(), 2u) << width;
    EXPECT_LE(places.size(), 8u) << width;
  }
}

TEST(Ticks, OfLogarithmsAreAtLeastThreeWhereverTheRangeLies) {
  EXPECT_EQ(log_ticks({0.5, 2000.0}).size(), 4u);
  for (const AxisRange range :
       {AxisRange{3.8, 16.0}, AxisRange{5.1, 9.7}, AxisRange{1.0, 1.4}, AxisRange{90.0, 110.0}}) {
    const auto places = log_ticks(range);
    EXPECT_GE(places.size(), 3u) << range.low;
    for (const double place : places) EXPECT_TRUE(place >= range.low * 0.999 && place <= range.high * 1.001) << place;
  }
}

}  // namespace
}  // namespace liana::svg
