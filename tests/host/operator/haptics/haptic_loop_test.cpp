// The hand's loop: laws by what has been heard, loss and return, smoothness, passivity with everything attached.
#include "host/operator/haptics/haptic_loop.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

#include "tests/host/drives/bus/allocation_count.hpp"
#include "tests/host/operator/haptics/bilateral_rig.hpp"
#include "tests/host/operator/haptics/laws.hpp"
#include "tests/message.hpp"
#include "tests/rounds.hpp"

namespace liana::haptics {
namespace {

device::Sample held_at(double y_m, bool button = true, bool valid = true) {
  return {.valid = valid, .deadman = button, .pose = {{0.0, y_m, 0.0}}};
}

Motion tip_at_y(double y_m) { return {{0.0, y_m, 0.0}, {}}; }

// The force a second after a state has been heard, with a hand that stands and a state every 20 ms.
double settled_N(HapticLoop& loop, const StatePacket& state, double commanded_m) {
  double force_N = 0.0;
  for (std::uint32_t ms = 0; ms < 1000; ++ms) {
    StatePacket again = state;
    again.sequence += ms;
    loop.take(again);
    force_N = loop.step(held_at(0.0), {0.0, commanded_m, 0.0}).force_N[1];
  }
  return force_N;
}

// req:C14 req:C15
TEST(HapticLoop, FeelsTheArmByItsLaw) {
  struct Row {
    Law law;
    double expected_N;
  };
  for (const Row& row : {Row{Law::kClaim, -4.0}, Row{Law::kAbstract, -3.0}, Row{Law::kAligned, -1.0}}) {
    HandLoopTable table;
    table.law = row.law;
    HapticLoop loop(table);
    loop.predict(0, tip_at_y(0.000));
    loop.predict(20000, tip_at_y(0.010));
    loop.predict(40000, tip_at_y(0.015));
    // The arm is at 0 and had the command of 10 ms for 5 ms more: predicted then, half-way between 5 and 7.5 mm.
    EXPECT_NEAR(settled_N(loop, {1, 5000, 5000, tip_at_y(0.0)}, 0.020), row.expected_N, 1e-9) << name_of(row.law);
  }
}

TEST(HapticLoop, FeelsNothingBeforeAnythingIsHeardAndWithoutTheButton) {
  HapticLoop loop({});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(norm(loop.step(held_at(0.0), {0.0, 0.1, 0.0}).force_N), 0.0);
  HandLoopTable table;
  table.law = Law::kClaim;
  HapticLoop open(table);
  open.take(StatePacket{1, 0, 0, tip_at_y(0.0)});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(norm(open.step(held_at(0.0, false), {0.0, 0.1, 0.0}).force_N), 0.0);
}

// An arm that has had no command yet says nothing about the prediction of it.
TEST(HapticLoop, AlignedIsSilentUntilTheArmAnswersACommand) {
  HapticLoop loop({});
  loop.predict(0, tip_at_y(0.01));
  EXPECT_EQ(settled_N(loop, {1, -1, 0, tip_at_y(0.0)}, 0.02), 0.0);
}

TEST(HapticLoop, StatesThatComeLateOrTwiceAreDropped) {
  HapticLoop loop({});
  EXPECT_TRUE(loop.take(StatePacket{5, 0, 0, tip_at_y(0.0)}));
  EXPECT_FALSE(loop.take(StatePacket{4, 0, 0, tip_at_y(1.0)}));
  EXPECT_FALSE(loop.take(StatePacket{5, 0, 0, tip_at_y(1.0)}));
  EXPECT_EQ(loop.dropped(), 2);
}

TEST(HapticLoop, WhatIsNoLongerHeardFadesAndComesBackWithoutAJump) {
  HandLoopTable table;
  table.law = Law::kClaim;
  HapticLoop loop(table);
  double last_N = settled_N(loop, {1, 0, 0, tip_at_y(0.0)}, 0.03), largest_N = 0.0;
  EXPECT_NEAR(last_N, -6.0, 1e-9);
  const auto pass_ms = [&](int count) {
    for (int ms = 0; ms < count; ++ms) {
      const double now_N = loop.step(held_at(0.0), {0.0, 0.03, 0.0}).force_N[1];
      largest_N = std::max(largest_N, std::fabs(now_N - last_N));
      last_N = now_N;
    }
  };
  pass_ms(250);
  EXPECT_NEAR(last_N, -6.0, 1e-9);  // jitter alone does not weaken it
  pass_ms(250);
  EXPECT_NEAR(last_N, -6.0 * std::exp(-1.0), 0.03);
  pass_ms(2000);
  EXPECT_NEAR(last_N, 0.0, 0.01);
  loop.take(StatePacket{5000, 0, 0, tip_at_y(0.0)});
  pass_ms(100);
  EXPECT_NEAR(last_N, -6.0, 1e-9);
  EXPECT_LE(largest_N, 0.2 + 1e-9);
}

TEST(HapticLoop, WallsInSeveralSlotsAddUpAndOneThatIsNotThereIsRefused) {
  HapticLoop loop{HandLoopTable{}};
  const Plane floor{{0.0, 0.0, 1.0}, 0.0, 1000.0, 0.0}, side{{1.0, 0.0, 0.0}, 0.0, 500.0, 0.0};
  EXPECT_TRUE(loop.take(floor, 0));
  EXPECT_TRUE(loop.take(side, kMaxWalls - 1));
  EXPECT_FALSE(loop.take(side, kMaxWalls));
  HandForce felt;
  for (int k = 0; k < 100; ++k)
    felt = loop.step({.t_us = 1000 * k, .deadman = true, .pose = {{-0.002, 0.0, -0.001}, {1.0, 0.0, 0.0, 0.0}}}, {});
  EXPECT_NEAR(felt.wall_N[0], 1.0, 1e-9);
  EXPECT_NEAR(felt.wall_N[2], 1.0, 1e-9);
}

TEST(HapticLoop, ForceIsClampedToWhatTheDeviceCan) {
  HandLoopTable table;
  table.law = Law::kClaim;
  HapticLoop loop(table);
  ASSERT_TRUE(loop.take(Plane{{0.0, -1.0, 0.0}, -0.05, 1500.0, 10.0}));
  EXPECT_NEAR(settled_N(loop, {1, 0, 0, tip_at_y(0.0)}, 1.0), -12.0, 1e-9);
  for (int i = 0; i < 100; ++i) {
    const HandForce& force = loop.step(held_at(0.09), {0.0, 1.0, 0.0});
    EXPECT_LE(norm(force.force_N), 12.0 + 1e-9);
    EXPECT_TRUE(force.clamped);
  }
}

TEST(HapticLoop, ASampleThatIsNotValidGivesNoForce) {
  HandLoopTable table;
  table.law = Law::kClaim;
  HapticLoop loop(table);
  settled_N(loop, {1, 0, 0, tip_at_y(0.0)}, 0.03);
  EXPECT_EQ(norm(loop.step(held_at(0.0, true, false), {0.0, 0.03, 0.0}).force_N), 0.0);
}

TEST(HapticLoop, TablesOutOfRangeAreRefusedByName) {
  const auto refusal = [](void (*spoil)(HandLoopTable&)) -> std::string {
    HandLoopTable table;
    spoil(table);
    try {
      HapticLoop loop(table);
      return "accepted";
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
  };
  EXPECT_EQ(refusal([](HandLoopTable&) {}), "accepted");
  EXPECT_TRUE(names(refusal([](HandLoopTable& t) { t.gains.stiffness_N_m = 1001.0; }),
                    {"hand loop", "gains.stiffness_N_m", "1001", "0", "1000"}));
  EXPECT_NE(refusal([](HandLoopTable& t) { t.gains.scale = 0.0; }).find("gains.scale"), std::string::npos);
  EXPECT_NE(refusal([](HandLoopTable& t) { t.tank.share = 0.6; }).find("tank.share"), std::string::npos);
  EXPECT_NE(refusal([](HandLoopTable& t) { t.fade_s = std::numeric_limits<double>::quiet_NaN(); }).find("fade_s"),
            std::string::npos);
}

// One of the seeds that nobody chose: hand, wall, delay, jitter and loss at random.
rig::RigTable random_rig(std::uint64_t seed) {
  simulated::RandomStream random(seed, 51);
  rig::RigTable table;
  table.loop.law = kLaws[seed % 3];
  table.hand.mass_kg = random.uniform(0.3, 2.5);
  table.hand.stiffness_N_m = random.uniform(0.0, 1.0) < 0.3 ? 0.0 : random.uniform(0.0, 1000.0);
  table.hand.reaction_s = random.uniform(0.1, 0.3);
  table.link = {random.uniform(0.0, 2.0), random.uniform(0.0, 0.5), random.uniform(0.0, 0.3)};
  table.wall_N_m = random.uniform(0.0, 1.0) < 0.3 ? 0.0 : random.uniform(100.0, 20000.0);
  table.seed = seed;
  return table;
}

// A wall at the hand that comes and goes where the hand is.
Plane random_wall(simulated::RandomStream& random) {
  return {{0.0, -1.0, 0.0}, random.uniform(-0.06, 0.06), random.uniform(0.0, 3000.0), random.uniform(0.0, 30.0)};
}

// req:C14
TEST(HapticLoop, ThePortNeverGivesMoreThanATenthOfAJouleForAnyLawDelayOrHand) {
  int at_stake = 0;
  for (std::uint64_t seed = 1; seed <= rounds(100u); ++seed) {
    rig::BilateralRig rig(random_rig(seed));
    simulated::RandomStream random(seed, 52);
    double least_J = 0.0;
    while (rig.now_s() < 20.0) {
      const auto ms = std::llround(1000.0 * rig.now_s());
      if (seed % 2 == 0 && ms % 400 == 0) rig.loop().take(random_wall(random));
      rig.step(rig::reach_intent(rig.now_s()));
      least_J = std::min(least_J, rig.omega().absorbed_J());
    }
    ASSERT_GE(least_J, -0.1) << "seed " << seed;
    if (least_J < -0.05) ++at_stake;
  }
  EXPECT_GT(at_stake, rounds(100) / 5);
}

// The rate limit of the law is what is felt of every switch, loss and return; the tank only ever takes.
TEST(HapticLoop, ForceMovesByNoMoreThanItsRateAtSwitchesLossAndReturn) {
  for (std::uint64_t seed = 101; seed <= 100 + rounds(30u); ++seed) {
    rig::RigTable table = random_rig(seed);
    table.loop.damping_N_s_m = 0.0;  // of the hand, felt at once
    table.loop.tank.start_J = table.loop.tank.most_J = std::numeric_limits<double>::infinity();
    rig::BilateralRig rig(table);
    Vec3 last{};
    double largest_N = 0.0;
    for (int ms = 0; ms < 12000; ++ms) {
      if (ms % 700 == 0) rig.loop().choose(kLaws[static_cast<std::size_t>(ms / 700) % 3]);
      if (ms % 3000 == 0) rig.change_link(table.link);
      if (ms % 3000 == 1500) rig.change_link({table.link.delay_s, table.link.jitter, 1.0});
      rig.step(rig::reach_intent(rig.now_s()));
      largest_N = std::max(largest_N, norm(subtract(rig.force().force_N, last)));
      last = rig.force().force_N;
    }
    ASSERT_LE(largest_N, 0.2 + 1e-9) << "seed " << seed;
  }
}

TEST(HapticLoop, WithTheTankNoForceGrowsFasterThanItsRateAndItsReturn) {
  for (std::uint64_t seed = 131; seed <= 130 + rounds(30u); ++seed) {
    rig::RigTable table = random_rig(seed);
    table.loop.damping_N_s_m = 0.0;
    rig::BilateralRig rig(table);
    double last_N = 0.0, growth_N = 0.0;
    for (int ms = 0; ms < 12000; ++ms) {
      rig.step(rig::reach_intent(rig.now_s()));
      growth_N = std::max(growth_N, norm(rig.force().force_N) - last_N);
      last_N = norm(rig.force().force_N);
    }
    ASSERT_LE(growth_N, 0.2 + 0.12 + 1e-9) << "seed " << seed;  // the law's rate, and 12 N in 0.1 s
  }
}

TEST(HapticLoop, FreeMotionFeelsNothingOfAlignedAtAnyDelay) {
  for (const double delay_s : {0.0, 0.05, 0.5, 1.0, 2.0}) {
    rig::RigTable table;
    table.link = {delay_s, 0.0, 0.0};
    rig::BilateralRig rig(table);
    double most_N = 0.0;
    while (rig.now_s() < 11.0) {
      rig.step(rig::reach_intent(rig.now_s()));
      most_N = std::max(most_N, norm(rig.force().law_N));
    }
    EXPECT_LT(most_N, 0.1) << delay_s << " s";
  }
}

TEST(HapticLoop, TheSameSeedGivesTheSameForcesAndNothingComesFromTheHeap) {
  rig::RigTable table = random_rig(7);
  const auto one = std::make_unique<rig::BilateralRig>(table), two = std::make_unique<rig::BilateralRig>(table);
  one->loop().take(Plane{{0.0, -1.0, 0.0}, -0.01, 1500.0, 10.0});
  two->loop().take(Plane{{0.0, -1.0, 0.0}, -0.01, 1500.0, 10.0});
  test::AllocationCount::clear();
  test::AllocationCount::start();
  bool same = true;
  for (int ms = 0; ms < 8000; ++ms) {
    one->step(rig::reach_intent(one->now_s()));
    two->step(rig::reach_intent(two->now_s()));
    same = same && one->force().force_N == two->force().force_N;
  }
  test::AllocationCount::stop();
  EXPECT_TRUE(same);
  EXPECT_EQ(test::AllocationCount::value(), 0);
}

}  // namespace
}  // namespace liana::haptics
