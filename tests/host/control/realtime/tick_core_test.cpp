// How requests reach the tick.
#include "host/control/realtime/tick_core.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "tests/host/control/verification/sim_arm.hpp"

namespace liana::realtime {
namespace {

TEST(StopFlag, IsTakenOnceHoweverOftenItWasPressed) {
  StopFlag flag;
  EXPECT_FALSE(flag.take());
  flag.press();
  flag.press();
  EXPECT_TRUE(flag.is_pressed());
  EXPECT_TRUE(flag.take());
  EXPECT_FALSE(flag.is_pressed());
  EXPECT_FALSE(flag.take());
}

TEST(TickCore, AStopActsInTheNextTickThoughTheQueueOfRequestsIsFull) {
  const auto arm = std::make_unique<verification::SimArm>();
  ASSERT_TRUE(arm->enable());
  while (arm->link.requests.push(Request::kClear)) {
  }
  arm->link.stop.press();
  arm->tick();
  EXPECT_EQ(arm->now().state, OperatingState::kStopping);
}

TEST(TickCore, ARequestThatWaitsKeepsItsPlaceAndAStopOvertakesItAllTheSame) {
  const auto arm = std::make_unique<verification::SimArm>();
  const auto link = std::make_unique<ArmMailbox<cable::CableArm>>(arm->table());
  const auto core = std::make_unique<TickCore<cable::CableArm>>(arm->table(), *link);
  const auto inputs = std::make_unique<Inputs<cable::CableArm>>();
  link->requests.push(Request::kClear);
  core->step(*inputs, true);
  EXPECT_EQ(inputs->request, Request::kNone);
  EXPECT_EQ(core->next_request(), Request::kClear);
  link->stop.press();
  core->step(*inputs, true);
  EXPECT_EQ(inputs->request, Request::kStop);
  EXPECT_EQ(core->next_request(), Request::kNone) << "a clear from before it is void";
}

TEST(TickCore, WhatWasAskedForBeforeAStopDoesNotFollowIt) {
  const auto arm = std::make_unique<verification::SimArm>();
  for (int i = 0; i < 10; ++i) arm->interval();
  arm->link.requests.push(Request::kEnable);
  arm->link.stop.press();
  for (int i = 0; i < 20; ++i) arm->interval();
  EXPECT_EQ(arm->now().state, OperatingState::kDisabled);
  EXPECT_EQ(arm->link.requests.front(), nullptr);
  EXPECT_TRUE(arm->enable()) << "a request after the stop counts again";
}

}  // namespace
}  // namespace liana::realtime
