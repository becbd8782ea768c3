// Histograms of the real-time thread's times, and the message made of them.
#include "host/control/realtime/latency_histogram.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <thread>

#include "host/base/json/json.hpp"
#include "host/control/server/timing_message.hpp"

namespace liana::server {
namespace {

std::uint32_t nearest_rank(std::vector<std::uint32_t> times, double share) {
  std::sort(times.begin(), times.end());
  return times[static_cast<std::size_t>(std::ceil(share * static_cast<double>(times.size()))) - 1];
}

TEST(LatencyHistogram, PercentilesAreThoseOfTheSortedTimes) {
  std::mt19937 random(1);
  for (const std::size_t count : {1u, 2u, 3u, 99u, 100u, 101u, 5000u}) {
    realtime::LatencyHistogram histogram;
    std::vector<std::uint32_t> times;
    for (std::size_t i = 0; i < count; ++i) {
      times.push_back(static_cast<std::uint32_t>(random() % (random() % realtime::kLatencyBuckets + 1)));
      histogram.record(times.back());
    }
    const realtime::LatencyCounts counts = histogram.counts();
    EXPECT_EQ(counts.total(), count);
    for (const double share : {0.01, 0.5, 0.99, 1.0})
      EXPECT_EQ(counts.percentile_us(share), nearest_rank(times, share)) << count << " " << share;
    EXPECT_EQ(counts.worst_us, nearest_rank(times, 1.0));
  }
}

TEST(LatencyHistogram, WhatLiesBeyondTheBucketsIsCountedAndItsWorstIsExact) {
  realtime::LatencyHistogram histogram;
  for (int i = 0; i < 98; ++i) histogram.record(realtime::kLatencyBuckets - 1);
  histogram.record(123456);
  histogram.record(realtime::kLatencyBuckets);
  const realtime::LatencyCounts counts = histogram.counts();
  EXPECT_EQ(counts.count[realtime::kLatencyBuckets], 2u);
  EXPECT_EQ(counts.percentile_us(0.98), realtime::kLatencyBuckets - 1);
  EXPECT_EQ(counts.percentile_us(0.99), 123456u) << "the worst bounds what has no bucket of its own";
  EXPECT_EQ(counts.worst_us, 123456u);
}

TEST(LatencyHistogram, AResetForgetsCountsAndWorst) {
  realtime::LatencyHistogram histogram;
  for (const std::uint32_t time_us : {5u, 5u, 900u, 70000u}) histogram.record(time_us);
  histogram.reset();
  EXPECT_EQ(histogram.counts().total(), 0u);
  EXPECT_EQ(histogram.counts().worst_us, 0u);
  EXPECT_EQ(histogram.counts().percentile_us(0.5), 0u);
  histogram.record(7);
  EXPECT_EQ(histogram.counts().worst_us, 7u);
  EXPECT_EQ(histogram.counts().total(), 1u);
  histogram.record(3000);
  EXPECT_EQ(histogram.counts().worst_us, 3000u);
}

TEST(LatencyHistogram, NothingIsLostWhileAnotherThreadReadsAndResets) {
  constexpr std::uint64_t kTimes = 200000;
  const auto histogram = std::make_unique<realtime::LatencyHistogram>();
  std::atomic<bool> done{false};
  std::thread writer([&] {
    for (std::uint64_t i = 0; i < kTimes; ++i) histogram->record(static_cast<std::uint32_t>(i % 100));
    done = true;
  });
  std::uint64_t last = 0;
  while (!done) {
    const std::uint64_t total = histogram->counts().total();
    EXPECT_GE(total, last);
    last = total;
  }
  writer.join();
  const realtime::LatencyCounts counts = histogram->counts();
  EXPECT_EQ(counts.total(), kTimes);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(counts.count[i], kTimes / 100);
}

TEST(TimingMessage, ListsOnlyBucketsThatHoldSomething) {
  realtime::LatencyHistogram wakeup, tick;
  for (const std::uint32_t time_us : {3u, 3u, 8u}) wakeup.record(time_us);
  for (const std::uint32_t time_us : {40u, 41u, 5000u}) tick.record(time_us);
  const Json message = timing_message(wakeup.counts(), tick.counts(), realtime::Overruns{1, 2, 3, 9});
  EXPECT_EQ(message["ticks"], 3);
  EXPECT_EQ(message["wakeup_us"], Json::parse(R"({"median":3,"p99":8,"worst":8,"buckets":[[3,2],[8,1]]})"));
  EXPECT_EQ(message["tick_us"]["buckets"], Json::parse("[[40,1],[41,1],[2048,1]]"));
  EXPECT_EQ(message["tick_us"]["worst"], 5000);
  EXPECT_EQ(message["overruns"], 6);
  EXPECT_EQ(message["overrun_causes"], Json::parse(R"({"late_wake":1,"long_tick":2,"bus_wait":3,"lost_ticks":9})"));
}

TEST(TimingMessage, FitsIntoAPacketAfterADayInEveryBucket) {
  realtime::LatencyCounts counts;
  counts.count.fill(9'999'999);
  counts.worst_us = 4'000'000'000u;
  EXPECT_LT(timing_message(counts, counts, realtime::Overruns{}).dump().size(),
            65536u - 200u);  // and the answer's own fields
}

}  // namespace
}  // namespace liana::server
