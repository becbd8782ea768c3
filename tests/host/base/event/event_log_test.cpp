// Numbers without gaps, whatever happens.
#include "host/base/event/event_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace liana::event {
namespace {

class Log : public testing::Test {
 protected:
  void add(EventKind kind, const std::string& text = "") { log_.add(tick_, {.kind = kind, .text = text}); }
  void next_interval() { log_.begin_interval(tick_ += 5); }
  void intervals(double time_s) {
    for (double t_s = 0.0; t_s < time_s; t_s += 5 * kPeriod_s) next_interval();
  }
  static double value(const Event& event, const std::string& name) {
    for (const EventValue& each : event.values) {
      if (each.name == name) return each.value;
    }
    return -1.0;
  }
  std::size_t told(EventKind kind) const {
    return static_cast<std::size_t>(
        std::count_if(told_.begin(), told_.end(), [kind](const Event& event) { return event.kind == kind; }));
  }
  void expect_no_gaps() const {
    for (std::size_t i = 0; i < told_.size(); ++i) {
      EXPECT_EQ(told_[i].sequence, i + 1);
      EXPECT_GE(told_[i].tick, i == 0 ? 0 : told_[i - 1].tick);
    }
  }
  std::vector<std::string> shown() const {
    std::vector<std::string> texts;
    for (const Event& event : log_.shown()) texts.push_back(event.text);
    return texts;
  }

  std::uint64_t tick_ = 0;
  std::vector<Event> told_;
  static constexpr double kPeriod_s = 0.004;
  EventLog log_{[this](const Event& event) { told_.push_back(event); }, kPeriod_s};
};

TEST_F(Log, EventsAreNumberedFromOneWithTheTickOfTheirNote) {
  add(EventKind::kBoot, "a");
  next_interval();
  add(EventKind::kStop, "b");
  ASSERT_EQ(told_.size(), 2u);
  expect_no_gaps();
  EXPECT_EQ(told_[1].tick, 5u);
  EXPECT_EQ(told_[1].text, "b");
}

TEST_F(Log, TheNewestTenAreShownWithoutFaultsAndRefusedRequests) {
  for (int i = 0; i < 12; ++i) {
    add(EventKind::kTool, std::to_string(i));
    log_.add(tick_, {.kind = i % 2 == 0 ? EventKind::kFault : EventKind::kRefusal, .number = i, .text = "hidden"});
    log_.add(tick_, {.kind = EventKind::kBootProblem, .number = i, .text = "hidden"});
  }
  EXPECT_EQ(shown(), (std::vector<std::string>{"2", "3", "4", "5", "6", "7", "8", "9", "10", "11"}));
  EXPECT_EQ(told_.size(), 36u);
}

TEST_F(Log, WhoFloodsIsCountedAndKeepsNoOtherKindOut) {
  for (int i = 0; i < 1000; ++i) add(EventKind::kTool, std::to_string(i));
  add(EventKind::kStop, "the stop");
  EXPECT_EQ(told_.size(), EventLog::kMaxPerInterval + 1);
  EXPECT_EQ(told_.back().text, "the stop");
  next_interval();
  EXPECT_EQ(told_.back().kind, EventKind::kLeftOut);
  EXPECT_EQ(told_.back().number, 1000 - EventLog::kMaxPerInterval);
  EXPECT_EQ(told_.back().subject, "tool");
  add(EventKind::kTool, "again");
  EXPECT_EQ(told_.back().text, "again");
  const std::size_t before = told_.size();
  next_interval();
  EXPECT_EQ(told_.size(), before) << "nothing was left out in this one";
  expect_no_gaps();
}

// req:C12
TEST_F(Log, WhatStandsIsToldAtOnceThenOnceAMinuteAndWhenItIsOver) {
  for (int i = 0; i < 50 * 90; ++i, next_interval())
    log_.add(tick_, {.kind = EventKind::kFault, .values = {{"count", 25.0}}, .text = "25 more faults"});
  ASSERT_EQ(told_.size(), 2u) << "90 s";
  EXPECT_EQ(value(told_[0], "count"), 25.0);
  EXPECT_EQ(value(told_[0], "times"), -1.0);
  EXPECT_EQ(value(told_[1], "over"), 0.0);
  intervals(3.0);
  ASSERT_EQ(told_.size(), 3u);
  EXPECT_EQ(value(told_[2], "over"), 1.0);
  EXPECT_EQ(value(told_[2], "last_tick"), 5.0 * (50 * 90 - 1));
  EXPECT_EQ(1 + value(told_[1], "times") + value(told_[2], "times"), 50 * 90);
  EXPECT_EQ(25 + value(told_[1], "count") + value(told_[2], "count"), 25.0 * 50 * 90);
  intervals(120.0);
  EXPECT_EQ(told_.size(), 3u) << "it is told once that it is over";
  log_.add(tick_, {.kind = EventKind::kFault, .text = "anew"});
  EXPECT_EQ(told_.back().text, "anew");
  expect_no_gaps();
}

TEST_F(Log, WhatDiffersIsToldWhateverStandsBesideIt) {
  for (int i = 0; i < 100; ++i, next_interval()) {
    for (const char* drive : {"drive 1", "drive 2"})
      log_.add(tick_, {.kind = EventKind::kEmergency, .number = 0x8130, .subject = drive});
    log_.add(tick_, {.kind = EventKind::kEmergency, .number = 0x8120, .subject = "drive 1"});
  }
  EXPECT_EQ(told_.size(), 3u);
  for (const double state : {1.0, 0.0, 1.0, 0.0})
    log_.add(tick_,
             {.kind = EventKind::kHostWarning, .number = 1, .subject = "bus can0", .values = {{"state", state}}});
  EXPECT_EQ(told_.size(), 5u) << "each state of the interface";
  intervals(3.0);
  ASSERT_EQ(told_.size(), 10u);
  EXPECT_EQ(value(told_.back(), "state"), 0.0) << "the latest is told last";
}

TEST_F(Log, AFaultThatComesAgainAfterAClearIsToldAtOnce) {
  const auto fault = [this] { log_.add(tick_, {.kind = EventKind::kFault, .number = 3002, .subject = "drive 3"}); };
  fault();
  fault();
  log_.add(tick_, {.kind = EventKind::kClear, .number = 4});
  fault();
  EXPECT_EQ(told(EventKind::kFault), 1u) << "nothing was cleared";
  log_.add(tick_, {.kind = EventKind::kClear, .number = 0});
  EXPECT_EQ(told(EventKind::kFault), 2u) << "with its count before the clear";
  fault();
  EXPECT_EQ(told(EventKind::kFault), 3u);
  EXPECT_EQ(value(told_[2], "times"), 2.0);
}

TEST_F(Log, WhatSomebodyDoesIsToldTenTimesBeforeItIsCountedAndNothingIsLostAtTheEnd) {
  for (int i = 0; i < 200; ++i, next_interval())
    log_.add(tick_,
             {.kind = EventKind::kRefusal, .number = 6, .subject = "c", .text = "move_jp: " + std::to_string(i)});
  EXPECT_EQ(told_.size(), EventLog::kDoings);
  log_.add(tick_, {.kind = EventKind::kShutdown});
  ASSERT_EQ(told_.size(), EventLog::kDoings + 2u);
  EXPECT_EQ(value(told_[EventLog::kDoings], "times"), 200.0 - EventLog::kDoings);
  EXPECT_EQ(told_.back().kind, EventKind::kShutdown);
}

TEST_F(Log, WhoMakesUpNamesFillsNeitherMemoryNorDisk) {
  for (int i = 0; i < 100'000; ++i) {
    log_.add(tick_, {.kind = EventKind::kRefusal, .number = 1, .subject = "name " + std::to_string(i)});
    if (i % 20 == 19) next_interval();
  }
  intervals(3.0);
  const double seconds = 100'000 / 20 * 5 * kPeriod_s;
  EXPECT_LT(static_cast<double>(told_.size()), 2.0 * seconds * Standing<Event>::kMaxKeys / EventLog::kOver_s);
  double cases = 0.0;
  for (const Event& event : told_) cases += std::max(1.0, value(event, "times"));
  EXPECT_EQ(cases, 100'000.0);
  expect_no_gaps();
}

}  // namespace
}  // namespace liana::event
