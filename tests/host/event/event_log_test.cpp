// Numbers without gaps, whatever happens.
#include "host/event/event_log.hpp"

#include <gtest/gtest.h>

namespace liana::event {
namespace {

class Log : public testing::Test {
 protected:
  void add(EventKind kind, const std::string& text = "") { log_.add(tick_, {.kind = kind, .text = text}); }
  void next_interval() { log_.begin_interval(tick_ += 5); }
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
  EventLog log_{[this](const Event& event) { told_.push_back(event); }};
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
    add(i % 2 == 0 ? EventKind::kFault : EventKind::kRefusal, "hidden");
    add(EventKind::kBootProblem, "hidden");
  }
  EXPECT_EQ(shown(), (std::vector<std::string>{"2", "3", "4", "5", "6", "7", "8", "9", "10", "11"}));
  EXPECT_EQ(told_.size(), 36u);
}

TEST_F(Log, WhoFloodsIsCountedAndKeepsNoOtherKindOut) {
  for (int i = 0; i < 1000; ++i) add(EventKind::kTool);
  add(EventKind::kStop, "the stop");
  EXPECT_EQ(told_.size(), EventLog::kMostPerInterval + 1);
  EXPECT_EQ(told_.back().text, "the stop");
  next_interval();
  EXPECT_EQ(told_.back().kind, EventKind::kLeftOut);
  EXPECT_EQ(told_.back().number, 1000 - EventLog::kMostPerInterval);
  EXPECT_EQ(told_.back().subject, "tool");
  add(EventKind::kTool, "again");
  EXPECT_EQ(told_.back().text, "again");
  const std::size_t before = told_.size();
  next_interval();
  EXPECT_EQ(told_.size(), before) << "nothing was left out in this one";
  expect_no_gaps();
}

}  // namespace
}  // namespace liana::event
