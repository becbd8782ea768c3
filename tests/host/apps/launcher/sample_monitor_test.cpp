// What a run's states tell of samples: how far apart, how old at release and in force.
#include "host/apps/launcher/sample_monitor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "host/base/json/json.hpp"

namespace liana::launcher {
namespace {

// Released at 10 s; samples so much before.
Json state(const char* device, std::uint64_t command, double newest_s, double oldest_s, double lead_s) {
  const auto taken_us = [](double before_s) { return std::llround(1e6 * (10.0 - before_s)); };
  return {{"device", device},
          {"device_rate", {{"hz", nullptr}, {"min_s", 0.001}, {"max_s", 0.002}}},
          {"verdict",
           {{"sequence", command},
            {"source_stamp",
             {{"newest_us", taken_us(newest_s)},
              {"oldest_us", taken_us(oldest_s)},
              {"released_s", 10.0},
              {"in_force_s", 10.0 + lead_s}}}}}};
}

}  // namespace

// req:A24
TEST(SampleMonitor, TellsMedianAndWorstOfEachDevicesSamplesAtReleaseAndInForce) {
  SampleMonitor watch;
  watch.look(state("hand", 1, 0.0, 0.02, 0.02));
  watch.look(state("hand", 2, 0.01, 0.05, 0.01));
  watch.look(state("hand", 3, 0.002, 0.02, 0.03));
  watch.look(state("vr", 4, 0.0, 0.01, 0.02));
  const Json hand = watch.json().at("hand");
  EXPECT_NEAR(hand.at("to_release_s").at("median").get<double>(), 0.011, 1e-9);
  EXPECT_NEAR(hand.at("to_release_s").at("worst").get<double>(), 0.05, 1e-9);
  EXPECT_NEAR(hand.at("in_force_s").at("median").get<double>(), 0.04, 1e-9);
  EXPECT_NEAR(hand.at("in_force_s").at("worst").get<double>(), 0.06, 1e-9);
  EXPECT_NEAR(watch.json().at("vr").at("to_release_s").at("median").get<double>(), 0.005, 1e-9);
}

TEST(SampleMonitor, ACommandCountsOnceAndOneThatNoDeviceMadeNotAtAll) {
  SampleMonitor watch;
  watch.look(state("hand", 1, 0.0, 0.02, 0.02));
  watch.look(state("hand", 1, 0.5, 0.5, 0.02));
  Json planned = state("puck", 2, 0.5, 0.5, 0.02);
  planned["verdict"]["source_stamp"] = nullptr;
  watch.look(planned);
  EXPECT_NEAR(watch.json().at("hand").at("to_release_s").at("worst").get<double>(), 0.02, 1e-9);
  EXPECT_TRUE(watch.json().at("puck").at("to_release_s").is_null());
}

// req:A24
TEST(SampleMonitor, KeepsTheShortestAndLongestIntervalAndTheSlowestSecondOfAllUses) {
  SampleMonitor watch;
  EXPECT_TRUE(watch.json().is_null());
  EXPECT_FALSE(watch.slowest_hz());
  for (const auto& [hz, least_s, most_s] : {std::tuple{90.0, 0.011, 0.0112}, {45.0, 0.02, 0.03}, {90.0, 0.011, 0.011}})
    watch.look({{"device", "vr"}, {"device_rate", {{"hz", hz}, {"min_s", least_s}, {"max_s", most_s}}}});
  watch.look({{"device", "none"}, {"device_rate", nullptr}});
  EXPECT_EQ(watch.slowest_hz(), 45.0);
  const Json interval = watch.json().at("vr").at("interval_s");
  EXPECT_EQ(interval.at("least").get<double>(), 0.011);
  EXPECT_EQ(interval.at("most").get<double>(), 0.03);
}

}  // namespace liana::launcher
