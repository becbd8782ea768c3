// Hand samples: averaged over the interval, every one counted, dropouts handled.
#include "host/control/arbiter/hand_track.hpp"

#include <gtest/gtest.h>

namespace liana::arbiter {

namespace {

device::Sample sample(std::int64_t t_us, double x, bool valid = true, bool pressed = true) {
  return {.t_us = t_us, .valid = valid, .deadman = pressed, .pose = {{x, 0.0, 0.0}}};
}

// req:A24
TEST(HandTrack, TheReadingIsTheMeanOfEverySample) {
  HandTrack track;
  for (int i = 0; i < 20; ++i) track.add_sample(sample(1000 * i, 0.001 * i));
  const HandReading reading = track.finish_interval();
  EXPECT_EQ(reading.samples, 20u);
  EXPECT_EQ(reading.used, 20u);
  EXPECT_NEAR(reading.mean.position_m[0], 0.0095, 1e-12);
  EXPECT_TRUE(reading.has_mean && reading.pressed && !reading.let_go && !reading.lost);
}

TEST(HandTrack, RotationsAreAveragedAsTurns) {
  HandTrack track;
  for (const double angle : {0.0, 0.01, 0.02, 0.03}) {
    device::Sample s = sample(static_cast<std::int64_t>(angle * 1e6), 0.0);
    s.pose.quaternion = quaternion_of({0.0, 0.0, angle});
    track.add_sample(s);
  }
  EXPECT_NEAR(rotation_vector(track.finish_interval().mean.quaternion)[2], 0.015, 1e-9);
}

TEST(HandTrack, EachIntervalStartsEmptyAndKeepsTheLastPose) {
  HandTrack track;
  track.add_sample(sample(0, 0.1));
  track.finish_interval();
  const HandReading reading = track.finish_interval();
  EXPECT_EQ(reading.samples, 0u);
  EXPECT_FALSE(reading.has_mean);
}

// req:A32
TEST(HandTrack, AShortDropoutIsBridgedAndALongOneIsALoss) {
  HandTrack track;
  track.add_sample(sample(0, 0.0));
  track.finish_interval();
  track.add_sample(sample(150000, 0.0, false));
  EXPECT_FALSE(track.finish_interval().lost);
  track.add_sample(sample(260000, 0.0, false));
  EXPECT_TRUE(track.finish_interval().lost);
}

TEST(HandTrack, SamplesOfAnInvalidPoseOrAnOldTimeAreCountedOnly) {
  HandTrack track;
  track.add_sample(sample(1000, 0.1));
  track.add_sample(sample(1000, 0.2));
  device::Sample broken = sample(2000, 0.2);
  broken.pose.quaternion = {0.0, 0.0, 0.0, 0.0};
  track.add_sample(broken);
  const HandReading reading = track.finish_interval();
  EXPECT_EQ(reading.samples, 3u);
  EXPECT_EQ(reading.used, 1u);
  EXPECT_NEAR(reading.mean.position_m[0], 0.1, 1e-15);
}

TEST(HandTrack, WhatWasMovedWithAnOpenDeadmanDoesNotCount) {
  HandTrack track;
  track.add_sample(sample(0, 0.0));
  track.add_sample(sample(10000, 0.02, true, false));
  track.add_sample(sample(20000, 0.04));
  track.add_sample(sample(21000, 0.06));
  const HandReading reading = track.finish_interval();
  EXPECT_TRUE(reading.let_go);
  EXPECT_TRUE(reading.pressed);
  EXPECT_EQ(reading.used, 2u);
  EXPECT_NEAR(reading.mean.position_m[0], 0.05, 1e-12);
}

TEST(HandTrack, AHandWithAnOpenDeadmanHasNoMeanAndIsNotLost) {
  HandTrack track;
  for (int i = 0; i < 40; ++i) track.add_sample(sample(10000 * i, 0.01 * i, true, false));
  const HandReading reading = track.finish_interval();
  EXPECT_FALSE(reading.has_mean);
  EXPECT_FALSE(reading.lost);
}

}  // namespace
}  // namespace liana::arbiter
