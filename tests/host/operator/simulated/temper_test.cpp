// Lively hands do what their table says, for every seed (req:A49).
#include "host/operator/simulated/temper.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/rounds.hpp"

namespace liana::test {
namespace {

using simulated::lively_at_handles;
using simulated::LivelyHands;
using simulated::LivelyTable;
using simulated::Range;

constexpr double kTemperStep_s = 0.002;
constexpr std::uint64_t kAllSeeds = 6, kSeeds = rounds(kAllSeeds);
constexpr Pose kHere{{0.01, -0.02, 0.03}, {1.0, 0.0, 0.0, 0.0}};

// Gestures alone.
LivelyTable gestures_of(LivelyTable table) {
  table.tremor_m = table.drift_m = {0.0, 0.0};
  table.tremor_rad = table.drift_rad = 0.0;
  return table;
}

// Where a lively hand is beside where it is meant to be, and whether it has its grip.
struct LivelySamples {
  std::vector<Vec3> right_m, left_m, right_rad;
  std::vector<bool> grip, taken_up;
};

LivelySamples sampled(const LivelyTable& table, std::uint64_t seed, double seconds, bool careful = false) {
  LivelyHands hands(table, seed, 81);
  LivelySamples out;
  for (std::int64_t k = 0; static_cast<double>(k) * kTemperStep_s < seconds; ++k) {
    hands.advance(static_cast<double>(k) * kTemperStep_s, careful);
    const auto right = simulated::step_between(kHere, hands.right(kHere));
    out.right_m.push_back(right.shift_m);
    out.right_rad.push_back(right.turn_rad);
    out.left_m.push_back(simulated::step_between(kHere, hands.left(kHere)).shift_m);
    out.grip.push_back(hands.has_grip());
    out.taken_up.push_back(hands.is_taken_up());
  }
  return out;
}

struct MostOfWay {
  double way = 0.0, speed = 0.0, accel = 0.0;
};

Vec3 velocity(const std::vector<Vec3>& way, std::size_t i) {
  return scale(subtract(way[i + 1], way[i]), 1.0 / kTemperStep_s);
}

MostOfWay max_of(const std::vector<Vec3>& way) {
  MostOfWay most;
  for (std::size_t i = 0; i + 2 < way.size(); ++i) {
    most.way = std::max(most.way, norm(way[i]));
    most.speed = std::max(most.speed, norm(velocity(way, i)));
    most.accel = std::max(most.accel, norm(subtract(velocity(way, i + 1), velocity(way, i))) / kTemperStep_s);
  }
  return most;
}

// Power of one axis at a frequency, mean over the record.
double power_at(const std::vector<Vec3>& way, double hz) {
  double re = 0.0, im = 0.0;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const double phase = 2.0 * std::numbers::pi * hz * static_cast<double>(i) * kTemperStep_s;
    re += way[i][0] * std::cos(phase);
    im += way[i][0] * std::sin(phase);
  }
  const auto count = static_cast<double>(way.size());
  return 2.0 * (re * re + im * im) / (count * count);
}

double mean_square(const std::vector<Vec3>& way) {
  double sum = 0.0;
  for (const Vec3& p : way) sum += p[0] * p[0];
  return sum / static_cast<double>(way.size());
}

TEST(Temper, IsCalledGentleOrLivelyAndNothingElse) {
  EXPECT_EQ(simulated::temper_called("gentle"), simulated::Temper::kGentle);
  EXPECT_EQ(simulated::temper_called("lively"), simulated::Temper::kLively);
  for (const char* word : {"", "Lively", "wild"}) EXPECT_THROW(simulated::temper_called(word), std::invalid_argument);
}

TEST(Temper, GesturesStayWithinReachSpeedAndAccelerationAndComeNearThem) {
  for (const LivelyTable& table : {gestures_of(LivelyTable{}), gestures_of(lively_at_handles())}) {
    MostOfWay all;
    for (std::uint64_t seed = 1; seed <= kAllSeeds; ++seed) {
      const LivelySamples hands = sampled(table, seed, 120.0);
      for (const auto* way : {&hands.right_m, &hands.left_m}) {
        const MostOfWay most = max_of(*way);
        all = {std::max(all.way, most.way), std::max(all.speed, most.speed), std::max(all.accel, most.accel)};
      }
      const MostOfWay turn = max_of(hands.right_rad);
      EXPECT_LE(turn.way, table.turn_rad.most + 1e-9);
      EXPECT_LE(turn.speed, table.turn_rate_rad_s + 1e-6);
      EXPECT_LE(turn.accel, table.turn_accel_rad_s2 + 1e-3);
    }
    EXPECT_LE(all.way, table.reach_m.most + 1e-9);
    EXPECT_LE(all.speed, table.speed_m_s.most + 1e-6);
    EXPECT_LE(all.accel, table.accel_m_s2.most + 1e-3);
    EXPECT_GT(all.way, 0.9 * table.reach_m.most);
    EXPECT_GT(all.speed, 0.6 * table.speed_m_s.most);
    EXPECT_GT(all.accel, 0.8 * table.accel_m_s2.most);
  }
}

TEST(Temper, EveryPersonReversesMoreOftenThanTheyRest) {
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Vec3> way = sampled(gestures_of(LivelyTable{}), seed, 120.0).right_m;
    int reversals = 0, begins = 0;
    for (std::size_t i = 1; i + 2 < way.size(); ++i) {
      reversals += dot(velocity(way, i), velocity(way, i - 1)) < 0.0 ? 1 : 0;
      begins += norm(way[i]) == 0.0 && norm(way[i + 1]) > 0.0 ? 1 : 0;
    }
    EXPECT_GT(begins, 10) << seed;
    EXPECT_GE(reversals, begins) << seed;
  }
}

TEST(Temper, GripsAreLostOneToThreeTimesAMinuteAndBothThatAndTheNextGripAreInMotion) {
  constexpr double kMinutes = 5.0;
  for (const LivelyTable& table : {gestures_of(LivelyTable{}), gestures_of(lively_at_handles())}) {
    for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
      const LivelySamples hands = sampled(table, seed, 60.0 * kMinutes);
      int losses = 0;
      for (std::size_t i = 1; i + 1 < hands.grip.size(); ++i) {
        if (hands.grip[i] == hands.grip[i - 1]) continue;
        losses += hands.grip[i] ? 0 : 1;
        EXPECT_GT(norm(velocity(hands.right_m, i)), 0.02) << seed << " at " << static_cast<double>(i) * kTemperStep_s;
      }
      EXPECT_GE(losses, 0.8 * table.losses_per_min.least * kMinutes) << seed;
      EXPECT_LE(losses, 1.2 * table.losses_per_min.most * kMinutes) << seed;
    }
  }
}

TEST(Temper, TremorHasItsPowerFromEightToTwelveHertzAndTheStrengthOfItsRange) {
  LivelyTable table;
  table.reach_m = table.turn_rad = table.drift_m = {0.0, 0.0};
  table.drift_rad = 0.0;
  constexpr double kSeconds = 20.0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<Vec3> way = sampled(table, seed, kSeconds).right_m;
    double in_band = 0.0;
    for (double hz = 7.5; hz <= 12.5; hz += 1.0 / kSeconds) in_band += power_at(way, hz);
    EXPECT_GT(in_band, 0.97 * mean_square(way)) << seed;
    EXPECT_GT(std::sqrt(mean_square(way)), 0.8 * table.tremor_m.least) << seed;
    EXPECT_LT(std::sqrt(mean_square(way)), 1.2 * table.tremor_m.most) << seed;
  }
}

TEST(Temper, AHandDriftsByMillimetresInMinutesAndNotWhereItIsCareful) {
  LivelyTable table = gestures_of(LivelyTable{});
  table.reach_m = table.turn_rad = {0.0, 0.0};
  table.drift_m = LivelyTable{}.drift_m;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const MostOfWay most = max_of(sampled(table, seed, 300.0).right_m);
    EXPECT_GT(most.way, table.drift_m.least) << seed;
    EXPECT_LT(most.way, 5.0 * table.drift_m.most) << seed;
    EXPECT_LT(most.speed, 0.002) << seed;
    const std::vector<Vec3> careful = sampled(table, seed, 60.0, true).right_m;
    EXPECT_EQ(careful.front(), careful.back()) << seed;
  }
}

TEST(Temper, TwoHandsGoAgainstEachOtherAndAHandAlone) {
  int against = 0, right = 0, left = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const LivelySamples hands = sampled(gestures_of(lively_at_handles()), seed, 120.0);
    for (std::size_t i = 0; i < hands.right_m.size(); i += 100) {
      const double r = norm(hands.right_m[i]), l = norm(hands.left_m[i]);
      if (r > 0.0 && l > 0.0) {
        ++against;
        EXPECT_LT(norm(add(hands.right_m[i], hands.left_m[i])), 1e-12);
      }
      right += r > 0.0 && l == 0.0 ? 1 : 0;
      left += l > 0.0 && r == 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(against, left);
  EXPECT_GT(right, left);
  EXPECT_GT(left, 0);
}

TEST(Temper, NoGestureBeginsAndNoGripIsLostWhereAPersonIsCareful) {
  const LivelySamples hands = sampled(gestures_of(LivelyTable{}), 1, 120.0, true);
  EXPECT_EQ(max_of(hands.right_m).way, 0.0);
  for (const bool grip : hands.grip) EXPECT_TRUE(grip);
}

TEST(Temper, TheOtherDeviceIsHeldFromTimeToTime) {
  const LivelyTable table;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<bool> held = sampled(table, seed, 300.0).taken_up;
    double since_s = 0.0;
    int times = 0;
    for (std::size_t i = 1; i < held.size(); ++i) {
      since_s += kTemperStep_s;
      if (held[i] == held[i - 1]) continue;
      const Range& range = held[i] ? table.other_every_s : table.other_s;
      EXPECT_GT(since_s, range.least - 0.01) << seed;
      EXPECT_LT(since_s, range.most + 0.01) << seed;
      times += held[i] ? 1 : 0;
      since_s = 0.0;
    }
    EXPECT_GE(times, 5) << seed;
  }
}

TEST(Temper, OneSeedIsOneHandHoweverOftenItIsLookedAtAndAnotherSeedIsAnother) {
  const LivelySamples once = sampled(LivelyTable{}, 7, 60.0), again = sampled(LivelyTable{}, 7, 60.0);
  EXPECT_EQ(once.right_m, again.right_m);
  EXPECT_EQ(once.grip, again.grip);
  EXPECT_NE(once.right_m, sampled(LivelyTable{}, 8, 60.0).right_m);
  LivelyHands seldom(LivelyTable{}, 7, 81);
  for (std::size_t i = 0; i < once.right_m.size(); i += 11) {
    seldom.advance(static_cast<double>(i) * kTemperStep_s, false);
    const Vec3 seen = simulated::step_between(kHere, seldom.right(kHere)).shift_m;
    EXPECT_NEAR(norm(subtract(seen, once.right_m[i])), 0.0, 1e-9) << i;
    EXPECT_EQ(seldom.has_grip(), once.grip[i]) << i;
  }
}

}  // namespace
}  // namespace liana::test
