#include "host/gateway/refusal_log.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace liana::gateway {
namespace {

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(RefusalLog, TellsWhatFromWhomAndWhyOnOneLine) {
  testing::internal::CaptureStderr();
  RefusalLog log;
  log.note(5.0, "path", "127.0.0.1", "'/x\ny\x1b[2J\xff': nothing is there");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "liana-gateway: refused path from 127.0.0.1: '/x?y?[2J?': nothing is there\n");
}

TEST(RefusalLog, TellsSoManyASecondAndCountsTheRest) {
  testing::internal::CaptureStderr();
  RefusalLog log;
  for (int i = 0; i < 1000; ++i) log.note(5.0, "malformed", "::1", std::string(10000, 'x'));
  log.tick(5.5);
  const std::string first = testing::internal::GetCapturedStderr();
  EXPECT_EQ(lines_of(first), RefusalLog::kMostPerSecond);
  EXPECT_LT(first.size(), RefusalLog::kMostPerSecond * 300);
  testing::internal::CaptureStderr();
  log.tick(6.1);
  log.tick(8.0);
  log.note(8.0, "malformed", "::1", "again");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "liana-gateway: refused 980 more\nliana-gateway: refused malformed from ::1: again\n");
}

}  // namespace
}  // namespace liana::gateway
