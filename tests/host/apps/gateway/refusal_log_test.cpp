#include "host/apps/gateway/refusal_log.hpp"

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
  log.complain(5.0, "libwebsockets", "accept: errno 24\n");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "liana-gateway: refused path from 127.0.0.1: '/x?y?[2J?': nothing is there\n"
            "liana-gateway: libwebsockets: accept: errno 24\n");
}

TEST(RefusalLog, WhatGoesOnIsCountedAndToldOnceAMinuteAndWhatIsNewAtOnce) {
  testing::internal::CaptureStderr();
  RefusalLog log;
  for (int i = 0; i < 1000; ++i) log.note(5.0, "malformed", "::1", std::string(10000, 'x'));
  log.tick(5.5);
  const std::string first = testing::internal::GetCapturedStderr();
  EXPECT_EQ(lines_of(first), RefusalLog::kAtOnce);
  EXPECT_LT(first.size(), RefusalLog::kAtOnce * 300);
  testing::internal::CaptureStderr();
  log.note(30.0, "malformed", "::1", "the newest");
  log.note(30.0, "no_token", "::1", "another");
  log.tick(64.0);
  log.tick(66.0);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "liana-gateway: refused no_token from ::1: another\n"
            "liana-gateway: refused malformed from ::1: the newest (and 997 like it)\n");
}

TEST(RefusalLog, ManyAddressesAndWhatALibrarySaysFillNoDisk) {
  testing::internal::CaptureStderr();
  RefusalLog log;
  for (int i = 0; i < 100'000; ++i) {
    log.note(i * 0.001, "no_hello", "fe80::" + std::to_string(i), "none");
    log.complain(i * 0.001, "libwebsockets", std::to_string(i));
    if (i % 100 == 0) log.tick(i * 0.001);
  }
  EXPECT_LT(lines_of(testing::internal::GetCapturedStderr()), 600u);
}

}  // namespace
}  // namespace liana::gateway
