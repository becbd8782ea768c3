#include "host/control/arbiter/goal_search.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::arbiter {

using namespace cable;

namespace {

inverse_kinematics::GoalIkProblem problem_with(double node_z_m) {
  inverse_kinematics::GoalIkProblem problem;
  problem.from_rad = zhu2022::radians(zhu2022::kPrepare_deg);
  problem.tip_in_base = forward_kinematics(zhu2022::table(), problem.from_rad).tip_in_base;
  problem.node[0] = {3, {0.7, 0.3, node_z_m}, 1.0, 0.0};
  return problem;
}

TEST(GoalSearch, GivesTheResultOfTheLastStartOnce) {
  GoalSearch search(zhu2022::table());
  EXPECT_FALSE(search.take(true));
  search.start(problem_with(0.3));
  search.start(problem_with(-0.3));
  const auto found = search.take(true);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->theta_rad, inverse_kinematics::solve_goal(zhu2022::table(), problem_with(-0.3)).theta_rad);
  EXPECT_FALSE(search.is_wanted());
  EXPECT_FALSE(search.take(true));
}

TEST(GoalSearch, IsStartedWithoutWaitingForItsResult) {
  GoalSearch search(zhu2022::table());
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  (void)inverse_kinematics::solve_goal(zhu2022::table(), problem_with(0.3));
  const auto solved = Clock::now();
  for (int i = 0; i < 1000; ++i) search.start(problem_with(0.3));
  EXPECT_LT(Clock::now() - solved, 200 * (solved - start)) << "1000 of them";
}

TEST(GoalSearch, WhatWasForgottenDoesNotComeBack) {
  GoalSearch search(zhu2022::table());
  search.start(problem_with(0.3));
  search.forget();
  EXPECT_FALSE(search.is_wanted());
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_FALSE(search.take(false));
  search.start(problem_with(-0.3));
  for (int i = 0; i < 5000 && search.is_wanted(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const auto found = search.take(false);
    if (found) {
      EXPECT_EQ(found->theta_rad, inverse_kinematics::solve_goal(zhu2022::table(), problem_with(-0.3)).theta_rad);
    }
  }
  EXPECT_FALSE(search.is_wanted());
}

}  // namespace
}  // namespace liana::arbiter
