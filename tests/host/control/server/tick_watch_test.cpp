// The longest tick of each command interval, for the state.
#include "host/control/server/tick_watch.hpp"

#include <gtest/gtest.h>

namespace liana::server {
namespace {

TEST(TickWatch, TellsTheLongestTickSinceTheLastLook) {
  realtime::LatencyHistogram ticks;
  TickWatch watch;
  EXPECT_FALSE(watch.longest_us(ticks.counts()));
  for (const std::uint32_t time_us : {90u, 140u, 60u}) ticks.record(time_us);
  EXPECT_EQ(watch.longest_us(ticks.counts()), 140u);
  ticks.record(70);
  EXPECT_EQ(watch.longest_us(ticks.counts()), 70u);
  EXPECT_FALSE(watch.longest_us(ticks.counts()));
}

TEST(TickWatch, WhatTakesLongerThanAllBucketsIsTheLastOne) {
  realtime::LatencyHistogram ticks;
  TickWatch watch;
  ticks.record(1000000);
  EXPECT_EQ(watch.longest_us(ticks.counts()), realtime::kLatencyBuckets);
}

TEST(TickWatch, GoesOnAfterTheCountsWereReset) {
  realtime::LatencyHistogram ticks;
  TickWatch watch;
  for (const std::uint32_t time_us : {90u, 140u}) ticks.record(time_us);
  EXPECT_TRUE(watch.longest_us(ticks.counts()));
  ticks.reset();
  ticks.record(80);
  EXPECT_EQ(watch.longest_us(ticks.counts()), 80u);
}

}  // namespace
}  // namespace liana::server
