// The lag of a tip behind a hand, told from both ways.
#include "host/operator/station/lag_meter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace liana::station {
namespace {

constexpr double kInterval_s = 0.02;
constexpr double kScale = 4.0;

double hand_way_m(double t_s) { return t_s < 1.0 ? 0.0 : 0.02 * (t_s - 1.0) + 0.004 * std::sin(2.0 * (t_s - 1.0)); }

// A hand that grips at 1 s; the tip by `tip_m`, followed from `engaged_s` on.
LagMeter meter(double engaged_s, const std::function<double(double)>& tip_m) {
  LagMeter meter;
  for (int k = 0; k < 500; ++k) {
    const double t_s = k * kInterval_s;
    meter.hand(t_s, t_s >= 1.0, {0.3 + hand_way_m(t_s), 0.0, 0.0}, kScale);
    const Vec3 tip{1.7 + tip_m(t_s), 0.2, 0.0};
    meter.arm(t_s, t_s >= engaged_s, tip, tip);
  }
  return meter;
}

TEST(LagMeter, FindsTheDelayOfATipThatFollowsLate) {
  for (const double lag_s : {0.0, 0.13, 0.55, 1.40}) {
    const LagMeter late = meter(1.0 + lag_s, [lag_s](double t_s) { return kScale * hand_way_m(t_s - lag_s); });
    ASSERT_TRUE(late.commanded().median_s) << lag_s;
    EXPECT_NEAR(*late.commanded().median_s, lag_s, 0.03);
    EXPECT_NEAR(*late.measured().worst_s, lag_s, 0.05);
  }
}

TEST(LagMeter, TellsNothingOfATipThatNoLagExplains) {
  const LagMeter away = meter(1.0, [](double t_s) { return -kScale * hand_way_m(t_s); });
  EXPECT_FALSE(away.commanded().median_s);
  const LagMeter still = meter(1.0, [](double) { return 0.0; });
  EXPECT_FALSE(still.measured().median_s);
}

TEST(LagMeter, TellsNothingWhereNobodyFollows) {
  EXPECT_FALSE(meter(1e9, [](double t_s) { return kScale * hand_way_m(t_s); }).commanded().median_s);
}

}  // namespace
}  // namespace liana::station
