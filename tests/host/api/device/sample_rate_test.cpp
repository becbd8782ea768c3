// How regularly a device's samples come, and the alarm below 50 a second.
#include "host/api/device/sample_rate.hpp"

#include <gtest/gtest.h>

#include <random>

namespace liana::device {

namespace {

constexpr double kInterval_s = 0.02;

// Samples `step_us` apart for `time_s`, handed over at the end of each command interval.
class SteadyDevice {
 public:
  void run(SampleRate& rate, double time_s, std::int64_t step_us) {
    for (double end_s = now_s_ + time_s; now_s_ < end_s - 1e-9;) {
      now_s_ += kInterval_s;
      for (; static_cast<double>(next_us_) * 1e-6 < now_s_; next_us_ += step_us) rate.add(next_us_);
      rate.finish_interval(kInterval_s);
    }
  }
  void silence(SampleRate& rate, double time_s) {
    for (double end_s = now_s_ + time_s; now_s_ < end_s - 1e-9; now_s_ += kInterval_s)
      rate.finish_interval(kInterval_s);
    next_us_ = static_cast<std::int64_t>(now_s_ * 1e6);
  }

 private:
  double now_s_ = 0.0;
  std::int64_t next_us_ = 0;
};

}  // namespace

// req:A24
TEST(SampleRate, IsThatOfTheDevicesClockWithLeastAndMostInterval) {
  struct Row {
    std::int64_t step_us;
    double hz;
    bool slow;
  };
  for (const Row row : {Row{1000, 1000.0, false}, Row{11111, 90.0, false}, Row{20000, 50.0, false},
                        Row{20100, 49.75, false}, Row{20408, 49.0, true}, Row{40000, 25.0, true}}) {
    SampleRate rate;
    SteadyDevice device;
    device.run(rate, 3.0, row.step_us);
    EXPECT_NEAR(rate.now_hz().value(), row.hz, 0.02) << row.step_us;
    EXPECT_NEAR(rate.mean_hz(), row.hz, 0.02) << row.step_us;
    EXPECT_NEAR(rate.least_s(), 1e-6 * static_cast<double>(row.step_us), 1e-12);
    EXPECT_NEAR(rate.most_s(), 1e-6 * static_cast<double>(row.step_us), 1e-12);
    EXPECT_EQ(rate.is_slow(), row.slow) << row.step_us;
  }
}

// req:A24
TEST(SampleRate, ADeviceThatFallsUnderFiftyHertzIsSlowUntilItIsFastAgain) {
  SampleRate rate;
  SteadyDevice device;
  device.run(rate, 2.0, 11111);
  EXPECT_FALSE(rate.is_slow());
  device.run(rate, 2.0, 30000);
  EXPECT_TRUE(rate.is_slow());
  device.run(rate, 2.0, 20100);
  EXPECT_TRUE(rate.is_slow()) << "49.75 Hz: it does not flicker";
  device.run(rate, 2.0, 11111);
  EXPECT_FALSE(rate.is_slow());
  EXPECT_NEAR(rate.most_s(), 0.03, 1e-9) << "the longest interval is kept";
}

TEST(SampleRate, SilenceIsSlowButOnlyAfterTheFirstSample) {
  SampleRate rate;
  SteadyDevice device;
  device.silence(rate, 5.0);
  EXPECT_FALSE(rate.is_slow());
  EXPECT_FALSE(rate.now_hz());
  device.run(rate, 1.0, 1000);
  device.silence(rate, 2.0);
  EXPECT_TRUE(rate.is_slow());
  EXPECT_EQ(rate.now_hz(), 0.0);
}

TEST(SampleRate, SamplesThatComeInBundlesAreNotSlow) {
  std::mt19937 random(7);
  SampleRate rate;
  std::int64_t t_us = 0;
  for (int interval = 0, late = 0; interval < 1000; ++interval) {
    late = late > 0 ? late - 1 : static_cast<int>(random() % 8);
    const std::int64_t until_us = 20000 * (interval + 1);
    for (; late == 0 && t_us < until_us; t_us += 11111) rate.add(t_us);
    rate.finish_interval(kInterval_s);
    ASSERT_FALSE(rate.is_slow()) << interval;
  }
  EXPECT_NEAR(rate.mean_hz(), 90.0, 0.01);
}

TEST(SampleRate, ASampleThatIsNotNewerCountsButHasNoInterval) {
  SampleRate rate;
  for (const std::int64_t t_us : {0, 10000, 10000, 5000, 20000}) rate.add(t_us);
  EXPECT_EQ(rate.count(), 5u);
  EXPECT_NEAR(rate.least_s(), 0.01, 1e-12);
  EXPECT_NEAR(rate.mean_hz(), 100.0, 1e-9);
}

}  // namespace liana::device
