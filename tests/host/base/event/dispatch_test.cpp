// Stages of commands as lines: compact, and read back as they were written.
#include "host/base/event/dispatch.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace liana::event {
namespace {

TEST(DispatchLine, OfEveryStageReadsBackAsItWasWritten) {
  const std::vector<Dispatch> written{
      {.stage = Stage::kSetpoint, .tick = 5610, .command = 17, .number = 2, .subject = "mission"},
      {.stage = Stage::kExecution, .tick = 5610, .command = 17, .share = 0.4125, .text = "cable 3: 0.413"},
      {.stage = Stage::kSimulation,
       .tick = 5610,
       .command = 17,
       .number = 208,
       .share = 1.5,
       .margins = {{-0.0021, 3.25, 1.5, 12.0, 512.0}},
       .text = "panel"},
      {.stage = Stage::kRefusal, .tick = 5611, .command = 17, .number = 208, .subject = "stop", .text = "panel"},
      {.stage = Stage::kRequest, .tick = 5612, .number = 7, .subject = "a client", .text = "servo_cp refused"}};
  for (const Dispatch& each : written) {
    const auto read = dispatch_from_line(dispatch_line(each));
    ASSERT_TRUE(read) << dispatch_line(each);
    EXPECT_EQ(*read, each) << dispatch_line(each);
  }
}

TEST(DispatchLine, OfACommandThatIsReleasedIsShort) {
  EXPECT_EQ(dispatch_line({.stage = Stage::kStart, .tick = 5615, .command = 17}), "5615\tstart\t17\t\t\t\t\t");
}

TEST(DispatchLine, SaysWhatWasNotLookedAt) {
  const std::string line =
      dispatch_line({.stage = Stage::kSimulation, .tick = 1, .command = 1, .margins = {{NAN, 1.0, 1.0, 1.0, NAN}}});
  EXPECT_NE(line.find("\t- 1 1 1 -\t"), std::string::npos) << line;
  EXPECT_TRUE(std::isnan((*dispatch_from_line(line)->margins)[0]));
}

TEST(DispatchLine, CannotBeForgedByWhatIsInIt) {
  const std::string line =
      dispatch_line({.stage = Stage::kRequest, .tick = 1, .subject = "a\n2\tstart", .text = "b\tc"});
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(dispatch_from_line(line)->subject, "a 2 start");
}

TEST(DispatchLine, ThatIsNoneIsNotRead) {
  for (const char* line : {"", "#tick", "1\tstart\t17", "x\tstart\t17\t\t\t\t\t", "1\tbegins\t17\t\t\t\t\t",
                           "1\tstart\t17\t\t\t\t1 2\t", "1\tstart\t17\t\t\tmuch\t\t"})
    EXPECT_FALSE(dispatch_from_line(line)) << line;
}

}  // namespace
}  // namespace liana::event
