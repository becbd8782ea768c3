// Deadman, clutch and tracking state of the device in use.
#include "host/control/arbiter/teleop_input.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

#include "tests/host/control/arbiter/interval.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

class Steering : public testing::Test {
 protected:
  Steering() {
    now_.tip_command = {{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};
    now_.node_command_m[2] = {0.5, 0.5, 0.0};
    use_.kind = device::Kind::kVrControllers;
    use_.mapping.scale = 2.0;
    use_.node = 3;
    steer_.use(use_);
  }
  std::optional<TeleopGoal> interval(double x, bool pressed = true, bool valid = true) {
    for (int i = 0; i < 2; ++i) {
      t_us_ += 10000;
      steer_.add({.t_us = t_us_, .valid = valid, .deadman = pressed, .pose = {{x, 0.0, 0.0}}});
    }
    return steer_.finish_interval(now_, kInterval_s);
  }
  cable::Outputs now_{};
  DeviceUse use_{};
  TeleopInput steer_;
  std::int64_t t_us_ = 0;
};

TEST_F(Steering, TheFirstGoalIsWhereTheTipIs) {
  const auto goal = interval(0.3);
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->tip_in_base.position_m, now_.tip_command.position_m);
}

TEST_F(Steering, MovesAreCountedFromTheAnchor) {
  interval(0.3);
  interval(0.303);
  EXPECT_NEAR(interval(0.304)->tip_in_base.position_m[0], 1.008, 1e-12);
}

// req:A27
TEST_F(Steering, AnOpenDeadmanMovesNothingAndReindexes) {
  interval(0.3);
  EXPECT_FALSE(interval(0.32, false));
  EXPECT_FALSE(steer_.engaged());
  const auto goal = interval(0.36);
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->tip_in_base.position_m, now_.tip_command.position_m) << "no jump on engaging again";
}

// req:A24
TEST_F(Steering, AGoalIsMadeOfTheSamplesOfItsIntervalAndOfTheLastOnesWhereNoneCame) {
  EXPECT_LT(steer_.made_of_us(), 0);
  interval(0.3);
  interval(0.302);
  EXPECT_EQ(steer_.made_from_us(), 30000);
  EXPECT_EQ(steer_.made_of_us(), 40000);
  ASSERT_TRUE(steer_.finish_interval(now_, kInterval_s));
  EXPECT_EQ(steer_.made_from_us(), 30000);
  EXPECT_EQ(steer_.made_of_us(), 40000);
  interval(0.32, false);
  steer_.use(use_);
  EXPECT_LT(steer_.made_from_us(), 0);
}

// req:A32
TEST_F(Steering, AfterALossTheOperatorHasToLetGoFirst) {
  interval(0.3);
  for (int i = 0; i < 20; ++i) interval(0.3, true, false);
  EXPECT_FALSE(steer_.engaged());
  EXPECT_STREQ(steer_.reason(), "tracking lost");
  EXPECT_FALSE(interval(0.3)) << "tracking is back, but the deadman was never opened";
  EXPECT_FALSE(interval(0.3, false));
  EXPECT_TRUE(interval(0.3));
}

// req:A32
TEST_F(Steering, AStandingHandThatIsNotSeenForAWhileKeepsTheGoal) {
  interval(0.3);
  const Pose before = interval(0.3)->tip_in_base;
  for (int i = 0; i < 7; ++i) {  // 140 ms
    const auto goal = interval(0.3, true, false);
    ASSERT_TRUE(goal);
    EXPECT_EQ(goal->tip_in_base.position_m, before.position_m);
  }
}

// The goal of a hand at constant velocity, as if it had been seen all the time.
// req:A32
TEST_F(Steering, AHandThatIsNotSeenForAWhileIsTakenToGoOnAsItWent) {
  constexpr double kStep_m = 3e-4;  // 15 mm/s
  double x = 0.3;
  for (int i = 0; i < 120; ++i) interval(x += kStep_m);
  double before_m = interval(x += kStep_m)->tip_in_base.position_m[0];
  for (int i = 0; i < 20; ++i) {
    const bool seen = i >= 8;
    const auto goal = interval(x += kStep_m, true, seen);
    ASSERT_TRUE(goal) << i;
    EXPECT_NEAR(goal->tip_in_base.position_m[0] - before_m, 2.0 * kStep_m, 1e-3 * kStep_m) << i;
    before_m = goal->tip_in_base.position_m[0];
  }
}

// req:A32
TEST_F(Steering, ANodeThatIsLedByAHandThatIsNotSeenGoesOnForAQuarterOfASecond) {
  constexpr double kStep_m = 3e-4;
  double x = 0.0;
  const auto left = [&](bool valid) {
    steer_.add({.t_us = t_us_ + 1, .hand = 1, .valid = valid, .deadman = true, .pose = {{x += kStep_m, 0.0, 0.0}}});
    return interval(0.3)->node.position_m[0];
  };
  double before_m = 0.0;
  for (int i = 0; i < 60; ++i) before_m = left(true);
  const double lost_at_m = before_m;
  for (int i = 0; i < 30; ++i) {
    const double now_m = left(i < 6 ? false : i > 9);
    EXPECT_TRUE(i >= 6 || std::fabs(now_m - before_m - 2.0 * kStep_m) < 1e-3 * kStep_m) << i;
    before_m = now_m;
  }
  steer_.add({.t_us = t_us_ + 1, .hand = 1, .valid = true, .deadman = true, .pose = {{x, 0.0, 0.0}}});
  for (int i = 0; i < 100; ++i) before_m = interval(0.3)->node.position_m[0];  // the left hand's samples have ended
  EXPECT_LT(before_m - lost_at_m, 2.0 * kStep_m * (31.0 + kTrackingLost_s / kInterval_s));
  EXPECT_EQ(interval(0.3)->node.position_m[0], before_m) << "stands at last";
}

// req:A12
TEST_F(Steering, ASilentDeviceDisengages) {
  interval(0.3);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(steer_.finish_interval(now_, kInterval_s)) << i;
  EXPECT_FALSE(steer_.finish_interval(now_, kInterval_s)) << "0.08 s, and what the interval before may have lacked";
  EXPECT_STREQ(steer_.reason(), "device silent");
}

// Ways of a device to die or to lie, while its hand leads the tip at 50 mm/s, trembling: of what is sent for the
// samples of one interval, the k-th since it began, and the reason that is told. None: the tip goes on as the hand
// does.
struct Lie {
  const char* name;
  const char* reason;
  std::function<std::vector<device::Sample>(std::vector<device::Sample>, int)> told;
};

std::vector<Lie> lies() {
  using Samples = std::vector<device::Sample>;
  const auto each = [](const auto& change) {
    return [change](Samples samples, int k) {
      for (device::Sample& s : samples) change(s, k);
      return samples;
    };
  };
  const auto kept = std::make_shared<Pose>();
  return {
      {"asleep", "device silent", [](Samples, int) { return Samples{}; }},
      {"says that it is stale", "input stale", each([](device::Sample& s, int) { s.stale = true; })},
      {"frozen", "values stuck", each([kept](device::Sample& s, int k) {
         if (k == 0) *kept = s.pose;
         s.pose = *kept;
       })},
      {"jumps by 10 mm", "hand jumped", each([](device::Sample& s, int) { s.pose.position_m[1] += 0.01; })},
      {"jumps by 150 mm", "hand jumped", each([](device::Sample& s, int) { s.pose.position_m[1] += 0.15; })},
      {"jumps by 2 m", "hand jumped", each([](device::Sample& s, int) { s.pose.position_m[1] += 2.0; })},
      {"turns by 10 deg at once", "hand jumped", each([](device::Sample& s, int) {
         s.pose.quaternion = multiply(quaternion_of({0.0, 0.17, 0.0}), s.pose.quaternion);
       })},
      {"turns by 80 deg at once", "hand jumped", each([](device::Sample& s, int) {
         s.pose.quaternion = multiply(quaternion_of({0.0, 1.4, 0.0}), s.pose.quaternion);
       })},
      {"late by 0.3 s", "input late", each([](device::Sample& s, int) { s.t_us -= 300'000; })},
      {"clock set on by 0.3 s", "clock set", each([](device::Sample& s, int) { s.t_us += 300'000; })},
  };
}

// req:A12 req:A32
TEST_F(Steering, EveryWayOfADeviceToDieOrToLieHoldsWithinATenthOfASecondAndIsNamed) {
  for (const Lie& lie : lies()) {
    steer_.use(use_);
    const auto interval_of = [&](const auto& told) {
      std::vector<device::Sample> samples;
      for (int i = 0; i < 2; ++i) {
        t_us_ += 10000;
        const double t_s = 1e-6 * static_cast<double>(t_us_), tremor = 0.0003 * std::sin(57.0 * t_s);
        samples.push_back({.t_us = t_us_, .deadman = true, .pose = {{0.05 * t_s, tremor, 0.0}}});
      }
      for (const device::Sample& sample : told(samples)) steer_.add(sample);
      return steer_.finish_interval(now_, kInterval_s);
    };
    Vec3 before_m{};
    for (int i = 0; i < 50; ++i) {
      const auto goal = interval_of([](const auto& s) { return s; });
      ASSERT_TRUE(goal) << lie.name;
      before_m = goal->tip_in_base.position_m;
    }
    int k = 0;
    for (; k < 10; ++k) {
      const auto goal = interval_of([&](const auto& s) { return lie.told(s, k); });
      if (!goal) break;
      EXPECT_LT(norm(subtract(goal->tip_in_base.position_m, before_m)), 0.011 * (k + 1)) << lie.name;
      EXPECT_LT(norm(rotation_vector(goal->tip_in_base.quaternion)), 0.01) << lie.name;
    }
    EXPECT_LT((k + 1) * kInterval_s, 0.1) << lie.name;
    EXPECT_STREQ(steer_.reason(), lie.reason) << lie.name;
    EXPECT_FALSE(interval_of([](const auto& s) { return s; })) << lie.name << ": the deadman was never opened";
  }
}

// Samples that lianad does not believe (not a number, a clock that was set back, twice the same time) never come here.
// req:A12
TEST_F(Steering, ADeviceWhoseSamplesAreRefusedIsNamedAsThat) {
  interval(0.3);
  for (int i = 0; i < 4; ++i) {
    steer_.note_refused(2);
    steer_.finish_interval(now_, kInterval_s);
  }
  EXPECT_STREQ(steer_.reason(), "samples refused");
}

// req:A32
TEST_F(Steering, AHandThatHasJumpedIsTakenAgainFromWhereItIs) {
  for (int i = 0; i < 20; ++i) interval(0.3);
  EXPECT_FALSE(interval(0.5));
  interval(0.5, false);
  const auto goal = interval(0.5);
  ASSERT_TRUE(goal);
  EXPECT_EQ(goal->tip_in_base.position_m, now_.tip_command.position_m);
  EXPECT_STREQ(steer_.reason(), "");
}

// req:A31 req:A32
TEST_F(Steering, ALeftHandThatJumpsLeavesItsNodeWhereItWas) {
  const auto left = [&](double x, bool pressed) {
    steer_.add({.t_us = t_us_ + 1, .hand = 1, .deadman = pressed, .pose = {{x, 0.0, 0.0}}});
    return interval(0.3)->node.position_m[0];
  };
  left(0.0, false);
  double before_m = 0.0;
  for (int i = 0; i < 20; ++i) before_m = left(0.001 * i, true);
  for (int i = 0; i < 20; ++i) EXPECT_NEAR(left(0.3, true), before_m, 0.005) << i;
  left(0.3, false);
  for (int i = 0; i < 20; ++i) before_m = left(0.3 - 0.001 * i, true);
  EXPECT_NEAR(before_m, now_.node_command_m[2][0] + 0.001 * 19 * 2.0 - 0.038, 0.01) << "taken again from there";
}

// A hand behind a link that is late by now more, now less: what its tracker jumped to is not filled in either.
TEST_F(Steering, NothingIsPutIntoAJumpOfTheTracker) {
  const auto after = [&](int intervals, double y) {
    for (int i = 1; i < intervals; ++i) steer_.finish_interval(now_, kInterval_s);
    t_us_ += 20000 * intervals;
    steer_.add({.t_us = t_us_, .deadman = true, .pose = {{0.3, y, 0.0}}});
    return steer_.finish_interval(now_, kInterval_s);
  };
  for (int i = 0; i < 200; ++i) {
    const auto goal = after(1 + i % 2, i % 17 == 16 ? 0.5 : 0.0);
    ASSERT_TRUE(goal) << i;
    EXPECT_NEAR(goal->tip_in_base.position_m[1], 0.0, 1e-9) << i;
  }
}

// Samples that wait for slower ones are no silence, and whoever opens the deadman is not waited for.
// req:A12
TEST_F(Steering, BehindAVaryingDelayTheDeadmanOpensAtOnce) {
  const auto after = [&](int intervals) {
    for (int i = 1; i < intervals; ++i) steer_.finish_interval(now_, kInterval_s);
    t_us_ += 20000 * (intervals - 1);
    return interval(0.3);
  };
  for (int i = 0; i < 60; ++i) EXPECT_TRUE(after(1 + i % 3)) << i;
  interval(0.3);
  interval(0.3);
  EXPECT_LT(steer_.made_of_us(), t_us_) << "it waits";
  EXPECT_FALSE(interval(0.3, false));
  EXPECT_FALSE(steer_.engaged());
}

TEST_F(Steering, ADroppedAnchorStartsAgainFromTheTip) {
  interval(0.3);
  interval(0.304);
  now_.tip_command.position_m = {1.05, 0.0, 0.0};
  steer_.drop_anchor();
  EXPECT_EQ(interval(0.304)->tip_in_base.position_m, now_.tip_command.position_m);
}

TEST_F(Steering, AHoldByOthersNeedsAFreshGrip) {
  interval(0.3);
  steer_.let_go();
  EXPECT_FALSE(interval(0.3));
  interval(0.3, false);
  EXPECT_TRUE(interval(0.3));
}

// req:A31
TEST_F(Steering, TheLeftHandMovesTheNodeAndLeavesItThere) {
  const auto left = [&](double x, bool pressed) {
    steer_.add({.t_us = t_us_ + 1, .hand = 1, .deadman = pressed, .pose = {{x, 0.0, 0.0}}});
    return interval(0.3)->node;
  };
  EXPECT_EQ(left(0.0, false).node, 0) << "no node target before the left hand engages";
  EXPECT_EQ(left(0.0, true).position_m, now_.node_command_m[2]);
  EXPECT_NEAR(left(0.005, true).position_m[0], 0.51, 1e-12);
  EXPECT_NEAR(left(0.08, false).position_m[0], 0.51, 1e-12) << "let go: stays";
  EXPECT_EQ(left(0.08, false).node, 3);
}

TEST_F(Steering, EverySampleIsCounted) {
  for (int i = 0; i < 10; ++i) interval(0.3);
  EXPECT_EQ(steer_.samples(), 20u);
}

TEST_F(Steering, ADeviceIsSilentInTheFourthIntervalWithoutASample) {
  for (const bool refused : {false, true}) {
    steer_.use(use_);
    steer_.note_refused(1);
    interval(0.3);  // a sample that is believed: what was refused before is over
    if (refused) steer_.note_refused(1);
    for (int i = 1; i <= 3; ++i) {
      steer_.finish_interval(now_, kInterval_s);
      EXPECT_TRUE(steer_.engaged()) << i;
    }
    EXPECT_FALSE(steer_.finish_interval(now_, kInterval_s));
    EXPECT_FALSE(steer_.engaged());
    EXPECT_STREQ(steer_.reason(), refused ? "samples refused" : "device silent");
  }
}

TEST_F(Steering, ADeviceThatIsGoneHasToLetGoWhenItIsBack) {
  interval(0.3);
  steer_.lose_device();
  EXPECT_STREQ(steer_.reason(), "device gone");
  EXPECT_FALSE(interval(0.3));
  interval(0.3, false);
  EXPECT_TRUE(interval(0.3));
}

TEST_F(Steering, AnotherDeviceKnowsNothingOfTheOneBefore) {
  const std::vector<std::function<void()>> ends{
      [&] {
        for (int i = 0; i < 10; ++i) steer_.finish_interval(now_, kInterval_s);
      },
      [&] {
        steer_.add({.t_us = ++t_us_, .deadman = true, .stale = true, .pose = {{0.3, 0.0, 0.0}}});
      },
      [&] { steer_.add({.t_us = t_us_ + 1, .hand = 1, .deadman = true, .stale = true, .pose = {}}); },
      [&] { steer_.lose_device(); },
      [&] { steer_.leave_slit(); },
  };
  for (std::size_t i = 0; i < ends.size(); ++i) {
    steer_.use(use_);
    interval(0.3);
    ASSERT_TRUE(steer_.engaged()) << i;
    ends[i]();
    steer_.use(use_);
    EXPECT_FALSE(steer_.engaged()) << i;
    EXPECT_STREQ(steer_.reason(), "") << i;
    EXPECT_LT(steer_.made_of_us(), 0) << i;
    t_us_ += 10'000'000;  // its clock is another one
    steer_.add({.t_us = t_us_ + 1, .hand = 1, .deadman = true, .pose = {}});
    const auto goal = interval(0.3);
    ASSERT_TRUE(goal) << i;
    EXPECT_EQ(goal->node.node, 3) << i;
  }
}

TEST_F(Steering, TheLeftHandLeadsOnlyANodeThatIsChosenAndAfterALieOnlyWhenItHasLetGo) {
  const auto left = [&](double x, bool pressed, bool stale = false) {
    steer_.add({.t_us = t_us_ + 1, .hand = 1, .deadman = pressed, .stale = stale, .pose = {{x, 0.0, 0.0}}});
    return interval(0.3)->node;
  };
  left(0.0, true);
  const double before_m = left(0.002, true).position_m[0];
  left(0.002, true, true);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(left(0.002 + 0.001 * i, true).position_m[0], before_m) << i;
  left(0.006, false);
  left(0.006, true);
  EXPECT_NEAR(left(0.007, true).position_m[0], before_m + 0.002, 1e-12);
  use_.node = 0;
  steer_.use(use_);
  left(0.0, true);
  EXPECT_EQ(left(0.005, true).node, 0);
}

}  // namespace
}  // namespace liana::arbiter
