// The guard of the no-allocation build: what a tick must not do aborts with a message.
#include <gtest/gtest.h>

#include <fcntl.h>
#include <cstdio>
#include <memory>
#include <mutex>

#include "host/control/realtime/tick_guard.hpp"
#include "tests/host/control/verification/sim_arm.hpp"

namespace liana::realtime {
namespace {

std::unique_ptr<int> g_planted;  // global, so that no compiler can leave the allocation out

TEST(AllocGuardDeathTest, APlantedNewInsideATickAborts) {
  EXPECT_DEATH(
      {
        const TickGuard inside;
        g_planted = std::make_unique<int>(1);
      },
      "tick.*malloc");
}

TEST(AllocGuardDeathTest, FreeingInsideATickAborts) {
  g_planted = std::make_unique<int>(1);
  EXPECT_DEATH(
      {
        const TickGuard inside;
        g_planted.reset();
      },
      "tick.*free");
}

TEST(AllocGuardDeathTest, ALockInsideATickAborts) {
  static std::mutex mutex;
  EXPECT_DEATH(
      {
        const TickGuard inside;
        mutex.lock();
      },
      "tick.*pthread_mutex_lock");
}

TEST(AllocGuardDeathTest, OpeningAFileInsideATickAborts) {
  EXPECT_DEATH(
      {
        const TickGuard inside;
        (void)::open("/dev/null", O_RDONLY);
      },
      "tick.*open");
}

TEST(AllocGuard, OutsideATickEverythingIsAllowed) {
  { const TickGuard inside; }
  g_planted = std::make_unique<int>(1);
  EXPECT_FALSE(TickGuard::active());
}

// A thousand ticks with enabling, motion requests, a silent drive, a fault and its clearing.
// req:A10
TEST(AllocGuard, TicksAllocateNothingAlsoWhenThingsGoWrong) {
  auto arm = std::make_unique<verification::SimArm>();
  const auto run = [&](int ticks) {
    for (int i = 0; i < ticks; ++i) {
      const TickGuard inside;
      arm->tick();
    }
  };
  run(50);
  arm->link.requests.push(Request::kEnable);
  run(400);
  arm->link.requests.push(Request::kStop);
  run(300);
  arm->link.requests.push(Request::kClear);
  run(250);
  SUCCEED();
}

}  // namespace
}  // namespace liana::realtime
