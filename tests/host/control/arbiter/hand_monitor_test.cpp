// Which samples are a hand's: quick hands are, jumps of any size are not, and numbers that are stuck.
#include "host/control/arbiter/hand_monitor.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace liana::arbiter {
namespace {

using Finding = HandMonitor::Finding;

// To and fro by steps of the acceleration that are as hard as a hand's, at most `speed_m_s` fast, with tremor of three
// frequencies, stamped with an error and with a tracker's noise.
class QuickHand {
 public:
  QuickHand(double rate_hz, unsigned seed) : step_s_(1.0 / rate_hz), random_(seed) {}

  device::Sample next() {
    const double accel_m_s2 = std::fmod(t_s_, 0.4) < 0.2 ? 15.0 : -15.0;
    if (std::fabs(velocity_m_s_ + accel_m_s2 * step_s_) <= 1.5) velocity_m_s_ += accel_m_s2 * step_s_;
    way_m_ += velocity_m_s_ * step_s_;
    angle_rad_ = 1.2 * std::sin(2.0 * std::numbers::pi * 1.5 * t_s_);
    t_s_ += step_s_;
    double tremor_m = 0.0;
    for (const double hz : {8.3, 9.9, 11.7}) tremor_m += 0.0004 * std::sin(2.0 * std::numbers::pi * hz * t_s_);
    std::uniform_real_distribution<double> one(-1.0, 1.0);
    const Vec3 at_m{way_m_ + tremor_m + 0.0001 * one(random_), tremor_m + 0.0001 * one(random_), 0.0001 * one(random_)};
    const double late_s = std::min(0.0005, 0.2 * step_s_) * one(random_);
    return {.t_us = std::llround(1e6 * (t_s_ + late_s)),
            .deadman = true,
            .pose = {at_m, quaternion_of({angle_rad_, 0.001 * one(random_), 0.0})}};
  }
  double t_s() const { return t_s_; }

 private:
  double step_s_, t_s_ = 1.0, way_m_ = 0.0, velocity_m_s_ = 0.0, angle_rad_ = 0.0;
  std::mt19937_64 random_;
};

constexpr double kRates_hz[] = {50.0, 90.0, 120.0, 250.0, 1000.0};

// req:A32
TEST(HandMonitor, AQuickHandThatTremblesIsAHandAtEveryRate) {
  for (const double rate_hz : kRates_hz) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
      HandMonitor watch;
      QuickHand hand(rate_hz, seed);
      while (hand.t_s() < 21.0)
        ASSERT_EQ(watch.judge(hand.next()), Finding::kHand) << rate_hz << " Hz at " << hand.t_s() << " s";
    }
  }
}

TEST(HandMonitor, ASampleWithoutAPoseOrNoLaterThanTheLastIsUnseen) {
  const device::Sample good{.t_us = 1'000'000, .deadman = true, .pose = {{0.1, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}};
  HandMonitor watch;
  ASSERT_EQ(watch.judge(good), Finding::kHand);
  device::Sample next = good;
  EXPECT_EQ(watch.judge(next), Finding::kUnseen) << "of the same time";
  next.t_us = 1'010'000;
  next.valid = false;
  EXPECT_EQ(watch.judge(next), Finding::kUnseen);
  next.valid = true;
  next.pose.quaternion = {};
  EXPECT_EQ(watch.judge(next), Finding::kUnseen);
  next.pose = good.pose;
  EXPECT_EQ(watch.judge(next), Finding::kHand);
}

struct Jump {
  Vec3 way_m{};
  Vec3 turn_rad{};
};

std::vector<Finding> findings_after(const Jump& jump, double rate_hz, bool stays, unsigned seed) {
  HandMonitor watch;
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise_m(0.0, 0.0001);
  std::vector<Finding> findings;
  const int before = static_cast<int>(rate_hz), after = static_cast<int>(0.08 * rate_hz);
  for (int i = 0; i < before + after; ++i) {
    Pose pose{{0.05 * i / rate_hz + noise_m(random), noise_m(random), noise_m(random)}, {1.0, 0.0, 0.0, 0.0}};
    if (i == before || (i > before && stays)) {
      pose.position_m = add(pose.position_m, jump.way_m);
      pose.quaternion = quaternion_of(jump.turn_rad);
    }
    const Finding found = watch.judge({.t_us = std::llround(1e6 * i / rate_hz), .deadman = true, .pose = pose});
    if (i >= before) findings.push_back(found);
    EXPECT_TRUE(i >= before || found == Finding::kHand);
  }
  return findings;
}

const Jump kJumps[] = {{{0.010, 0.0, 0.0}, {}}, {{0.0, 0.012, 0.0}, {}}, {{0.0, 0.0, -0.03}, {}},
                       {{-0.1, 0.1, 0.0}, {}},  {{3.0, 1.0, 0.5}, {}},   {{}, {0.12, 0.0, 0.0}},
                       {{}, {0.0, 0.5, 0.0}},   {{}, {0.0, 0.0, 3.1}}};

// req:A32
TEST(HandMonitor, AJumpThatStaysIsFoundWithTheSampleAfterItWhateverItsSize) {
  for (const double rate_hz : {90.0, 250.0, 1000.0}) {
    for (const Jump& jump : kJumps) {
      const std::vector<Finding> found = findings_after(jump, rate_hz, true, 3);
      EXPECT_EQ(found[0], Finding::kDoubtful) << rate_hz;
      EXPECT_EQ(found[1], Finding::kJumped) << rate_hz;
      EXPECT_TRUE(std::all_of(found.begin() + 2, found.end(), [](Finding f) { return f == Finding::kHand; }));
    }
  }
}

// req:A32
TEST(HandMonitor, AJumpOfOneSampleIsLeftOut) {
  for (const double rate_hz : {90.0, 1000.0}) {
    for (const Jump& jump : kJumps) {
      const std::vector<Finding> found = findings_after(jump, rate_hz, false, 4);
      EXPECT_EQ(found[0], Finding::kDoubtful);
      EXPECT_TRUE(std::all_of(found.begin() + 1, found.end(), [](Finding f) { return f == Finding::kHand; }))
          << rate_hz;
    }
  }
}

TEST(HandMonitor, ATrackerThatIsHereAndThereHasJumpedAfterAWhile) {
  HandMonitor watch;
  Finding found = Finding::kHand;
  std::int64_t t_us = 0;
  for (; t_us < 500'000; t_us += 10'000) watch.judge({.t_us = t_us, .deadman = true});
  for (int i = 0; i <= 6 && found != Finding::kJumped; ++i, t_us += 10'000)
    found = watch.judge({.t_us = t_us, .deadman = true, .pose = {{0.3 + 0.1 * (i % 3), 0.2 * (i % 2), 0.0}}});
  EXPECT_EQ(found, Finding::kJumped);
}

TEST(HandMonitor, WithAnOpenDeadmanAHandMayBeAnywhereAndWhereItClosesToo) {
  HandMonitor watch;
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(watch.judge({.t_us = 10'000 * i, .deadman = i % 2 == 1, .pose = {{1.0 * i, 0.0, 0.0}}}), Finding::kHand);
}

TEST(HandMonitor, AfterALossAHandIsTakenUpOnItsWayAndNotElsewhere) {
  for (const auto& [off_m, expected] : {std::pair{0.01, Finding::kHand}, std::pair{0.05, Finding::kDoubtful}}) {
    HandMonitor watch;
    std::int64_t t_us = 0;
    for (; t_us < 500'000; t_us += 10'000)
      watch.judge({.t_us = t_us, .deadman = true, .pose = {{0.1e-6 * static_cast<double>(t_us), 0.0, 0.0}}});
    t_us += 150'000;
    const Vec3 at_m{0.1e-6 * static_cast<double>(t_us), off_m, 0.0};
    EXPECT_EQ(watch.judge({.t_us = t_us, .deadman = true, .pose = {at_m}}), expected) << off_m;
  }
}

// req:A12
TEST(HandMonitor, NumbersThatHaveAlwaysVariedAreStuckWithinEightyMilliseconds) {
  for (const double rate_hz : {90.0, 1000.0}) {
    HandMonitor watch;
    QuickHand hand(rate_hz, 7);
    device::Sample sample;
    while (hand.t_s() < 2.0) watch.judge(sample = hand.next());
    const std::int64_t from_us = sample.t_us;
    while (watch.judge(sample) != Finding::kStuck && sample.t_us < from_us + 200'000)
      sample.t_us += std::llround(1e6 / rate_hz);
    EXPECT_LE(sample.t_us, from_us + 80'000) << rate_hz;
  }
}

// An emulated hand without a tremor comes to stand like this; a frozen one has still been moving.
TEST(HandMonitor, AHandThatSlowsDownSmoothlyMayStandAndOneThatStopsInMotionMayNot) {
  for (const double rate_hz : kRates_hz) {
    for (const bool is_frozen : {false, true}) {
      HandMonitor watch;
      const double step_s = 1.0 / rate_hz, until_s = is_frozen ? 0.7035 : 1.0;
      bool is_stuck = false;
      for (double t_s = 0.0; t_s < 3.0; t_s += step_s) {
        const double s = std::min(t_s, until_s);
        const Pose pose{{0.05 * (1.0 - std::cos(std::numbers::pi * s)), 0.0, 0.0}};
        const Finding found = watch.judge({.t_us = std::llround(1e6 * t_s), .deadman = true, .pose = pose});
        is_stuck = is_stuck || found == Finding::kStuck;
      }
      EXPECT_EQ(is_stuck, is_frozen) << rate_hz;
    }
  }
}

// A hand that rests, of which only the tracker's noise moves, is frozen when that ends.
TEST(HandMonitor, NoiseThatEndsIsAStuckTracker) {
  HandMonitor watch;
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise_m(0.0, 0.00002);
  device::Sample sample{.t_us = 0, .deadman = true, .pose = {}};
  for (int i = 0; i < 200; ++i, sample.t_us += 11'000) {
    for (double& x_m : sample.pose.position_m) x_m = noise_m(random);
    ASSERT_EQ(watch.judge(sample), Finding::kHand) << i;
  }
  bool is_stuck = false;
  for (int i = 0; i < 10; ++i, sample.t_us += 11'000) is_stuck = is_stuck || watch.judge(sample) == Finding::kStuck;
  EXPECT_TRUE(is_stuck);
}

// Encoders at rest, or a tracker whose every pose is told twice.
TEST(HandMonitor, NumbersThatRepeatByNatureAreNotStuck) {
  HandMonitor watch;
  for (int i = 0; i < 1000; ++i) {
    const double x_m = i < 500 ? 0.0005 * (i / 2) : 0.125;
    ASSERT_EQ(watch.judge({.t_us = 10'000 * i, .deadman = true, .pose = {{x_m, 0.0, 0.0}}}), Finding::kHand) << i;
  }
}

// A pointer is a rate: it starts at once, and stands exactly.
TEST(HandMonitor, APointerStartsAtOnceAndStandsButDoesNotJump) {
  HandMonitor watch(limits_of(device::Kind::kPointer));
  double x_m = 0.0;
  for (int i = 0; i < 300; ++i) {
    x_m += i % 100 < 50 ? 0.01 : 0.0;
    ASSERT_EQ(watch.judge({.t_us = 10'000 * i, .deadman = true, .pose = {{x_m, 0.0, 0.0}}}), Finding::kHand) << i;
  }
  EXPECT_EQ(watch.judge({.t_us = 3'000'000, .deadman = true, .pose = {{x_m + 0.05, 0.0, 0.0}}}), Finding::kDoubtful);
  EXPECT_EQ(watch.judge({.t_us = 3'010'000, .deadman = true, .pose = {{x_m + 0.05, 0.0, 0.0}}}), Finding::kJumped);
}

}  // namespace
}  // namespace liana::arbiter
