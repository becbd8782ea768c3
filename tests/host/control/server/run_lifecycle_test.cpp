#include "host/control/server/run_lifecycle.hpp"

#include <gtest/gtest.h>

#include "firmware_like/cable_controller.hpp"

namespace liana::server {
namespace {

constexpr double kTick_s = 0.001;

class RunLifecycleTest : public ::testing::Test {
 protected:
  bool stops(std::uint64_t tick) { return run_.why_to_stop(tick, outputs_) != nullptr; }

  RunLifecycle run_{kTick_s, 20};
  cable::Outputs outputs_ = [] {
    cable::Outputs outputs;
    outputs.state = OperatingState::kEnabled;
    outputs.at_rest = 1;
    return outputs;
  }();
};

TEST_F(RunLifecycleTest, ARunGoesOnUntilSomebodyEndsIt) {
  EXPECT_FALSE(stops(100000));
  run_.ask_to_end();
  EXPECT_TRUE(stops(100020));
  EXPECT_TRUE(run_.was_asked_to_end());
}

TEST_F(RunLifecycleTest, AfterItsMissionARunWaitsUntilTheArmHasRested) {
  run_.mission_ends(1000);
  outputs_.at_rest = 0;
  EXPECT_FALSE(stops(5000));
  outputs_.at_rest = 1;
  EXPECT_FALSE(stops(6000));
  EXPECT_TRUE(stops(6020));
}

TEST_F(RunLifecycleTest, AnArmThatNeverRestsEndsTheRunAfterAMinute) {
  run_.mission_ends(1000);
  outputs_.at_rest = 0;
  EXPECT_FALSE(stops(61000));
  EXPECT_TRUE(stops(61020));
}

TEST_F(RunLifecycleTest, AFaultMakesTheWaitLonger) {
  run_.mission_ends(0);
  outputs_.faults.count = 1;
  EXPECT_FALSE(stops(5000));
  EXPECT_TRUE(stops(5020));
}

TEST_F(RunLifecycleTest, TheMissionsEndCountsBeforeARequestToEnd) {
  run_.mission_ends(1000);
  run_.ask_to_end();
  EXPECT_FALSE(stops(1020));
  EXPECT_STREQ(run_.why_to_stop(2020, outputs_), "the mission has ended");
}

TEST_F(RunLifecycleTest, ARunIsOverWhenDrivesAreOffAndClientsKnow) {
  EXPECT_TRUE(run_.stop(1000));
  EXPECT_FALSE(run_.stop(1020)) << "it stops already";
  EXPECT_FALSE(run_.is_over(1100, outputs_));
  outputs_.state = OperatingState::kDisabled;
  EXPECT_FALSE(run_.is_over(1020, outputs_));
  EXPECT_TRUE(run_.is_over(1021, outputs_));
}

TEST_F(RunLifecycleTest, DrivesThatDoNotGoOffKeepNoRunFromItsEnd) {
  run_.stop(1000);
  EXPECT_FALSE(run_.is_over(11000, outputs_));
  EXPECT_TRUE(run_.is_over(11001, outputs_));
}

}  // namespace
}  // namespace liana::server
