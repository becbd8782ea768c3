#include "host/control/realtime/last_stop.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <stdexcept>

#include "tests/host/control/verification/sim_arm.hpp"

namespace liana::realtime {
namespace {

TEST(LastStop, AnArmWhoseServiceFailedIsSwitchedOff) {
  const auto arm = std::make_unique<verification::SimArm>();
  ASSERT_TRUE(arm->enable());
  int ticks = 0;
  stop_without_service(arm->link, 2500, [&] {
    arm->tick();
    return ++ticks > 0;
  });
  EXPECT_EQ(arm->now().state, OperatingState::kDisabled);
  EXPECT_LT(ticks, 2500);
}

TEST(LastStop, EndsAtItsLimitAndWhenThereAreNoTicks) {
  const auto arm = std::make_unique<verification::SimArm>();
  ASSERT_TRUE(arm->enable());
  int ticks = 0;
  stop_without_service(arm->link, 3, [&] {
    arm->tick();
    return ++ticks > 0;
  });
  EXPECT_EQ(ticks, 3);
  stop_without_service(arm->link, 2500, [&] { return ++ticks < 0; });
  EXPECT_EQ(ticks, 4);
}

TEST(LastStop, WhatAThreadThrowsIsKeptAsItsProblem) {
  ThreadResult good, bad, odd;
  run_guarded([] {}, good);
  run_guarded([] { throw std::runtime_error("no memory"); }, bad);
  run_guarded([] { throw 7; }, odd);
  EXPECT_TRUE(good.over && bad.over && odd.over);
  EXPECT_EQ(good.problem, "");
  EXPECT_EQ(bad.problem, "no memory");
  EXPECT_NE(odd.problem, "");
}

}  // namespace
}  // namespace liana::realtime
