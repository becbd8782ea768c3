// The twin: what it predicts is what the Controller then does, and the stop after a command is part of it.
#include "host/control/verification/twin.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "host/control/verification/simulation_verifier.hpp"
#include "host/control/verification/verify.hpp"
#include "tests/host/control/verification/sim_arm.hpp"

namespace liana::verification {

namespace {

class TwinOfAnArm : public testing::Test {
 protected:
  TwinOfAnArm() : arm_(std::make_unique<SimArm>()) {}
  void SetUp() override { ASSERT_TRUE(arm_->enable()) << "faults: " << arm_->now().faults.count; }

  cable::Setpoint shifted_tip(double way_m, double speed_m_s = 0.1) const {
    cable::Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_in_base = arm_->now().tip_command;
    setpoint.tip_in_base.position_m[1] += way_m;
    setpoint.tip_speed_m_s = speed_m_s;
    return setpoint;
  }
  Candidate<cable::CableArm> candidate(const cable::Setpoint& setpoint) {
    const auto interval = static_cast<std::uint64_t>(arm_->table().interval_ticks);
    return release_.candidate(setpoint, 1, arm_->link.image.value().next_tick + interval, interval);
  }
  Prediction<cable::CableArm> predict(const Candidate<cable::CableArm>& candidate) {
    Prediction<cable::CableArm> prediction;
    Twin<cable::CableArm>::run(arm_->link.image.value(), released_, candidate, max_stop_ticks(arm_->table().tick_s),
                               prediction);
    return prediction;
  }
  std::optional<cable::Telecommand> release(const Candidate<cable::CableArm>& candidate,
                                            const Prediction<cable::CableArm>& prediction) {
    return release_.release(candidate, judge_execution<cable::CableArm>(arm_->table(), candidate, prediction),
                            simulate(candidate, prediction));
  }
  SimulationVerdict simulate(const Candidate<cable::CableArm>& candidate,
                             const Prediction<cable::CableArm>& prediction) {
    simulation_.watch(arm_->link.image.value());
    simulation_.begin(arm_->link.image.value(), candidate, prediction, false);
    return simulation_.verdict(kWhenever);
  }

  std::unique_ptr<SimArm> arm_;
  SimulationVerifier<cable::CableArm> simulation_{{arm_->table(), 0.03, 0.4, 0.2}, {arm_->table(), {}, {}, {}}};
  IssueStep<cable::CableArm> release_;
  std::vector<cable::Telecommand> released_;
};

// req:C1
TEST_F(TwinOfAnArm, PredictsTheNextTicksExactlyWhenTheDrivesAreIdeal) {
  const Candidate<cable::CableArm> wanted = candidate(shifted_tip(0.01));
  const Prediction<cable::CableArm> prediction = predict(wanted);
  const auto telecommand = release(wanted, prediction);
  ASSERT_TRUE(telecommand) << judge_execution<cable::CableArm>(arm_->table(), wanted, prediction).text
                           << simulate(wanted, prediction).text;
  arm_->link.released.push(*telecommand);
  while (arm_->ticks_done() < wanted.first_tick()) arm_->tick();
  double moved = 0.0;
  for (const cable::Outputs& predicted : prediction.ticks) {
    arm_->tick();
    EXPECT_EQ(predicted.theta_command_rad, arm_->now().theta_command_rad) << "tick " << predicted.tick;
    EXPECT_EQ(predicted.payout_command_m, arm_->now().payout_command_m);
    moved = std::max(moved, arm_->now().tip_speed_m_s);
  }
  EXPECT_GT(moved, 1e-4) << "the command did move the arm";
  EXPECT_TRUE(arm_->now().at_rest) << "and the stop after it is part of the prediction";
}

TEST_F(TwinOfAnArm, GoesThroughWhatIsAlreadyReleased) {
  const Candidate<cable::CableArm> first = candidate(shifted_tip(0.01));
  const auto telecommand = release(first, predict(first));
  ASSERT_TRUE(telecommand);
  released_.push_back(*telecommand);
  const auto interval = static_cast<std::uint64_t>(arm_->table().interval_ticks);
  const Candidate<cable::CableArm> second = release_.candidate(shifted_tip(0.01), 1, first.expiry_tick(), interval);
  EXPECT_GT(predict(second).ticks.front().tip_speed_m_s, 0.0) << "moving already because of the first";
}

// req:C7
TEST_F(TwinOfAnArm, TheSimulationFollowsWhatTheControllerWouldTellItsDrives) {
  const Candidate<cable::CableArm> wanted = candidate(shifted_tip(0.01));
  const SimulationVerdict verdict = simulate(wanted, predict(wanted));
  EXPECT_TRUE(verdict.passed()) << verdict.text;
  EXPECT_EQ(verdict.sequence, wanted.sequence());
  EXPECT_GT(verdict.margins.rate_deg_s, 0.0);
  EXPECT_LT(verdict.margins.rate_deg_s, 2.0) << "it moves";
}

TEST_F(TwinOfAnArm, TheSameCommandHasTheSameVerdictToTheBit) {
  const Candidate<cable::CableArm> wanted = candidate(shifted_tip(0.01));
  const Prediction<cable::CableArm> prediction = predict(wanted);
  const SimulationVerdict first = simulate(wanted, prediction), second = simulate(wanted, prediction);
  EXPECT_EQ(first.margins.rate_deg_s, second.margins.rate_deg_s);
  EXPECT_EQ(first.margins.tension_N, second.margins.tension_N);
  EXPECT_EQ(first.margin, second.margin);
}

// req:C9
TEST_F(TwinOfAnArm, TheSimulationHoldsTheArmAsItIsBelievedToBeAgainstTheSceneWhereItIsSeen) {
  const cable::RobotParams& table = arm_->table();
  MotionRules rules{table, {}, {}, {}};
  rules.scene.margins.prediction_m = 0.007;
  const cable::Outputs& now = arm_->link.image.value().last_outputs;
  const Vec3 tip_m = forward_kinematics(table, now.theta_measured_rad).tip_in_base.position_m;
  rules.scene.spheres = {{"ball", add(tip_m, {0.10, 0.0, 0.0}), 0.05}};
  SimulationVerifier<cable::CableArm> end({table, 0.03, 0.4, 0.2}, rules);
  const Candidate<cable::CableArm> stays = candidate(shifted_tip(0.0));
  const Prediction<cable::CableArm> prediction = predict(stays);
  const auto margins_m = [&](const cable::ThetaVector& theta_off_rad, const Vec3& shift_m, double prediction_m) {
    end.watch(arm_->link.image.value());
    end.believe(theta_off_rad, {shift_m, {1.0, 0.0, 0.0, 0.0}}, prediction_m);
    end.begin(arm_->link.image.value(), stays, prediction, false);
    return end.verdict(kWhenever).margins.clearance_m;
  };
  const double drawn_m = margins_m({}, {}, 0.007);
  EXPECT_NEAR(margins_m({}, {}, 0.005), drawn_m + 0.002, 1e-9);
  EXPECT_GT(margins_m({}, {0.01, 0.0, 0.0}, 0.007), drawn_m + 0.005);
  const double near_m = margins_m({}, {-0.01, 0.0, 0.0}, 0.007);
  EXPECT_LT(near_m, drawn_m - 0.005);
  cable::ThetaVector off_rad{};
  off_rad[2] = 0.003;
  EXPECT_GT(std::fabs(margins_m(off_rad, {}, 0.007) - drawn_m), 0.0005);
}

// req:C11
TEST_F(TwinOfAnArm, AVerdictThatIsNotThereInTimeIsARefusalAndTheNextOneIsNotForIt) {
  const Candidate<cable::CableArm> wanted = candidate(shifted_tip(0.01));
  const Prediction<cable::CableArm> prediction = predict(wanted);
  simulation_.begin(arm_->link.image.value(), wanted, prediction, false);
  const SimulationVerdict late = simulation_.verdict(0.0);
  if (!late.passed()) {  // a machine that is quick enough has it
    EXPECT_EQ(late.code, Refusal::kNoVerdict);
    EXPECT_FALSE(release_.release(wanted, judge_execution<cable::CableArm>(arm_->table(), wanted, prediction), late));
  }
  EXPECT_TRUE(simulation_.verdict(kWhenever).passed());
}

// Others make up for a pitch that goes into the plane with more than twice its rate: a stop on the way must not let
// them swing the tip.
TEST_F(TwinOfAnArm, AHoldAtThePreparePoseIsReleasedUpToFullSpeed) {
  cable::Setpoint hold = shifted_tip(0.0);
  hold.held_mask = 0x100;
  for (int i = 0; i < 200; ++i) {
    const Candidate<cable::CableArm> next = candidate(hold);
    const Prediction<cable::CableArm> prediction = predict(next);
    const auto telecommand = release(next, prediction);
    ASSERT_TRUE(telecommand) << "interval " << i << ": " << simulate(next, prediction).text;
    EXPECT_LE(prediction.ticks.size(), 250u) << "interval " << i;
    released_ = {*telecommand};
    arm_->link.released.push(*telecommand);
    arm_->interval();
  }
  EXPECT_FALSE(arm_->now().held_at_target) << "it is on its way";
  EXPECT_LT(arm_->now().theta_rate_rad_s[8], -0.013) << "at 0.8 deg/s";
}

TEST_F(TwinOfAnArm, TheArmItselfIsNotTouched) {
  const cable::ThetaVector before = arm_->now().theta_command_rad;
  predict(candidate(shifted_tip(0.05)));
  arm_->interval();
  EXPECT_EQ(arm_->now().theta_command_rad, before);
}

}  // namespace
}  // namespace liana::verification
