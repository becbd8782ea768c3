// What keeps the fault of a lost cable, and what speaks against leading its arm out.
#include "host/control/server/recovery.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/base/json/json.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/message.hpp"

namespace liana::server {
namespace {

using Path = arbiter::PathHistory<cable::ThetaVector>;

class RecoveryTest : public ::testing::Test {
 protected:
  RecoveryTest() {
    outputs_.tension_measured_N.fill(table_.tension.plan_N);
    path_.note(1, {});
    path_.note(2, cable::zhu2022::radians(cable::zhu2022::kPrepare_deg));
  }
  void lose(std::int16_t cable) {
    latch(outputs_.faults, {FaultNumber::kCableBreak, cable, 0, 7});
    outputs_.tension_measured_N[static_cast<std::size_t>(cable)] = 0.0;
  }
  LossView arm() const { return {table_, outputs_, release_, names_}; }

  cable::RobotParams table_ = cable::zhu2022::table();
  config::DriveNames names_{table_};
  cable::Outputs outputs_{};
  cable::SegmentReleaseState release_{};
  Path path_;
};

TEST_F(RecoveryTest, AClearIsTrueOnlyWhenTheFirstAndTheLastCableTakeTheFloor) {
  for (const std::int16_t cable : {std::int16_t{0}, std::int16_t{14}}) {
    outputs_ = {};
    outputs_.tension_measured_N.fill(table_.tension.plan_N);
    EXPECT_EQ(why_loss_stands(arm()), "");
    lose(cable);
    EXPECT_NE(why_loss_stands(arm()).find(names_.cable(static_cast<std::size_t>(cable))), std::string::npos);
    double& tension_N = outputs_.tension_measured_N[static_cast<std::size_t>(cable)];
    tension_N = table_.tension.floor_motor_N;
    EXPECT_EQ(why_loss_stands(arm()), "");
    tension_N = std::nextafter(tension_N, 0.0);
    EXPECT_NE(why_loss_stands(arm()), "");
  }
}

TEST_F(RecoveryTest, AFaultThatWasClearedForTheWayBackStandsUntilTheCableIsWhole) {
  release_ = {cable::SegmentReleaseStage::kBroken, 1, 4, cable::kLetGoSettleTicks};
  outputs_.tension_measured_N[4] = 0.0;
  EXPECT_NE(why_loss_stands(arm()), "");
  const Json now = recovery_json(arm(), path_);
  EXPECT_EQ(now["cables"], Json(std::vector<int>{5}));
  EXPECT_EQ(now["slack"], Json(std::vector<int>({4, 5, 6})));
  EXPECT_TRUE(now["recovers"].get<bool>());
}

TEST_F(RecoveryTest, AnArmThatIsOutIsToBeRepairedAndNotLedOutAgain) {
  release_ = {cable::SegmentReleaseStage::kBroken, 1, 4, cable::kLetGoSettleTicks};
  EXPECT_TRUE(names(recovery_json(arm(), path_)["next"].text(), {"liana recover", "--whole 5"}));
  path_.keep(1);
  const std::string next = recovery_json(arm(), path_)["next"];
  EXPECT_EQ(next.find("recover"), std::string::npos) << next;
  EXPECT_TRUE(names(next, {"--whole 5"})) << next;
}

TEST_F(RecoveryTest, WithoutALossOrAPathThereIsNoRecovery) {
  EXPECT_TRUE(recovery_json(arm(), path_).is_null());
  EXPECT_NE(why_not_recover(arm(), path_), "");
  lose(4);
  EXPECT_EQ(why_not_recover(arm(), path_), "");
  EXPECT_NE(why_not_recover(arm(), Path()), "");
}

TEST_F(RecoveryTest, ALostDriveIsToldWithWhatItsBrakeWouldPullBy) {
  outputs_.payout_command_m.fill(1e-5 * table_.cable_EA_N);  // of which 1 mm is 100 N
  latch(outputs_.faults, {FaultNumber::kDriveSilent, 14, 0, 7});
  const std::string why = why_not_recover(arm(), path_);
  EXPECT_NE(why.find(names_.drive(14)), std::string::npos) << why;
  EXPECT_NE(why.find("100.0 N"), std::string::npos) << why;
}

TEST_F(RecoveryTest, TwoCablesOfASegmentAreOneLossTwoOfTwoSegmentsAreNot) {
  lose(3);
  lose(5);
  EXPECT_EQ(why_not_recover(arm(), path_), "");
  lose(6);
  EXPECT_NE(why_not_recover(arm(), path_), "");
}

TEST_F(RecoveryTest, WeightThatTwoCablesCannotHoldIsRefusedWithTheCableThatWouldHaveToPush) {
  table_.gravity_m_s2 = {0.0, 0.0, -9.80665};
  lose(4);
  const std::string why = why_not_recover(arm(), path_);
  EXPECT_NE(why.find(" N, allowed "), std::string::npos) << why;
  EXPECT_EQ(recovery_json(arm(), path_)["slack"], Json(std::vector<int>{5})) << "its segment is not let go";
}

TEST_F(RecoveryTest, ACableOverTheCeilingEndsTheWayBackAndNothingElse) {
  outputs_.tension_measured_N[14] = max_recovery_N(table_);
  release_ = {cable::SegmentReleaseStage::kBroken, 1, 4, cable::kLetGoSettleTicks};
  EXPECT_EQ(overpulled_cable(arm()), "");
  outputs_.tension_measured_N[14] = std::nextafter(max_recovery_N(table_), 1e9);
  EXPECT_NE(overpulled_cable(arm()).find(names_.cable(14)), std::string::npos);
  release_ = {};
  EXPECT_EQ(overpulled_cable(arm()), "") << "an arm with all its cables has other monitors";
}

TEST_F(RecoveryTest, AnEnableWaitsForSlackCablesButNotForReleasedOnes) {
  const double needed_N = cable::kSlackCheckShare * table_.tension.floor_motor_N;
  outputs_.tension_measured_N[14] = needed_N;
  EXPECT_EQ(slack_cables(arm()), "");
  outputs_.tension_measured_N[14] = std::nextafter(needed_N, 0.0);
  EXPECT_NE(slack_cables(arm()).find(names_.cable(14)), std::string::npos);
  release_ = {cable::SegmentReleaseStage::kBroken, 4, 12, cable::kLetGoSettleTicks};
  EXPECT_EQ(slack_cables(arm()), "");
}

}  // namespace
}  // namespace liana::server
