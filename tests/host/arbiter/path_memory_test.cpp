// The stored path.
#include "host/arbiter/path_memory.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable_controller.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

using Path = PathMemory<ThetaVector>;

TEST(PathMemory, GivesPointsBackNewestFirstDownToATick) {
  Path path;
  for (std::uint64_t tick = 10; tick <= 50; tick += 10) {
    ThetaVector theta{};
    theta[0] = static_cast<double>(tick);
    path.note(tick, theta);
  }
  EXPECT_EQ((*path.step_back(25))[0], 50.0);
  EXPECT_EQ((*path.step_back(25))[0], 40.0);
  EXPECT_EQ((*path.step_back(25))[0], 30.0);
  EXPECT_FALSE(path.step_back(25)) << "the point of tick 20 is too old";
  EXPECT_EQ((*path.step_back(0))[0], 20.0);
}

TEST(PathMemory, StandingStillAddsNothing) {
  Path path;
  for (std::uint64_t tick = 0; tick < 100; ++tick) path.note(tick, ThetaVector{});
  EXPECT_TRUE(path.step_back(0));
  EXPECT_TRUE(path.empty());
}

}  // namespace
}  // namespace liana::arbiter
