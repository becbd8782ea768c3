// How requests reach the tick.
#include "host/control/realtime/tick_core.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "firmware_like/command/release.hpp"
#include "host/control/realtime/tick_times.hpp"

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

TEST(TickCore, ATelecommandIsTakenFromItsFirstTickUntilTheOneBeforeItExpires) {
  const cable::RobotParams table = cable::zhu2022::table();
  const auto link = std::make_unique<ArmMailbox<cable::CableArm>>(table);
  const auto core = std::make_unique<TickCore<cable::CableArm>>(table, *link);
  const auto inputs = std::make_unique<Inputs<cable::CableArm>>();
  const auto release = [&](std::uint64_t sequence, std::uint64_t first_tick, std::uint64_t expiry_tick) {
    link->released.push(Release::make(sequence, first_tick, expiry_tick, 1, cable::Setpoint{}));
  };
  const auto taken = [&](std::uint64_t tick) {
    inputs->tick = tick;
    core->step(*inputs);
    return inputs->telecommand.sequence();
  };
  release(1, 11, 20);
  EXPECT_EQ(taken(10), 0U) << "its time has not come";
  EXPECT_EQ(taken(11), 1U);
  EXPECT_EQ(taken(12), 0U) << "once";
  release(2, 12, 13);
  EXPECT_EQ(taken(13), 0U) << "expired";
  release(3, 12, 15);
  EXPECT_EQ(taken(14), 3U) << "overdue, in its last tick";
  release(4, 15, 30);
  release(5, 15, 30);
  release(6, 16, 30);
  EXPECT_EQ(taken(15), 5U) << "the newest that is due";
  EXPECT_EQ(taken(16), 6U);
}

TEST(TickCore, ARequestActsInOneTickAndAStopVoidsAllThatWait) {
  const cable::RobotParams table = cable::zhu2022::table();
  const auto link = std::make_unique<ArmMailbox<cable::CableArm>>(table);
  const auto core = std::make_unique<TickCore<cable::CableArm>>(table, *link);
  const auto inputs = std::make_unique<Inputs<cable::CableArm>>();
  link->requests.push(Request::kClear);
  core->step(*inputs);
  EXPECT_EQ(inputs->request, Request::kClear);
  core->step(*inputs);
  EXPECT_EQ(inputs->request, Request::kNone);
  while (link->requests.push(Request::kEnable)) {
  }
  link->stop.press();
  core->step(*inputs);
  EXPECT_EQ(inputs->request, Request::kStop);
  EXPECT_EQ(core->next_request(), Request::kNone);
}

TEST(TickCore, AnImageIsMadeAtTheEndOfEachIntervalAndLostRecordsAreCounted) {
  const auto arm = std::make_unique<verification::SimArm>();
  const auto interval = static_cast<std::uint64_t>(arm->table().interval_ticks);
  for (std::uint64_t done = 1; done <= 520; ++done) {
    arm->tick();
    arm->link.image.refresh();
    arm->link.report.refresh();
    const auto& image = arm->link.image.value();
    ASSERT_EQ(image.next_tick, done / interval * interval);
    ASSERT_EQ(arm->link.report.value().records_lost, done <= 511 ? 0 : done - 511);
    if (done < interval) continue;
    EXPECT_FALSE(image.fresh);
    EXPECT_EQ(image.last_inputs.tick, image.next_tick - 1);
  }
}

TEST(TickTimes, AMissedDeadlineIsNamedAfterWhatTookTheTickBefore) {
  struct Row {
    std::uint64_t heard_us, ended_us;
    Overruns expected;
  };
  for (const Row& row : {Row{100, 3999, {1, 0, 0, 2}}, Row{3000, 4000, {0, 1, 0, 2}}, Row{3001, 4000, {0, 0, 1, 2}}}) {
    TickTiming timing;
    TickTimes times(4000, timing);
    Overruns overruns;
    times.begin({1, 0, 0, false}, 50000, overruns);
    times.heard(50000 + row.heard_us);
    times.end({1, 7, 0, false}, 50000 + row.ended_us);
    EXPECT_EQ(overruns.total() + overruns.lost_ticks, 0U);
    times.begin({4, 0, 2, false}, 62000, overruns);
    EXPECT_EQ(overruns.late_wake, row.expected.late_wake) << row.ended_us;
    EXPECT_EQ(overruns.long_tick, row.expected.long_tick) << row.heard_us;
    EXPECT_EQ(overruns.bus_wait, row.expected.bus_wait) << row.heard_us;
    EXPECT_EQ(overruns.lost_ticks, 2U);
    EXPECT_EQ(timing.tick_us.counts().worst_us, row.ended_us - row.heard_us);
    EXPECT_EQ(timing.wakeup_us.counts().worst_us, 7U);
  }
}

}  // namespace
}  // namespace liana::realtime
