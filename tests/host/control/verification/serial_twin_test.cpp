// The twin of a serial arm: what it predicts for a released candidate is what the Controller then does, whatever the
// pose and the command, when the drives are nominal.
#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "host/control/verification/verify.hpp"
#include "tests/firmware_like/serial_rig.hpp"
#include "tests/host/control/verification/sim_arm.hpp"

namespace liana::verification {
namespace {

using serial::SerialArm;
using serial::micro::Random;

constexpr int kSeeds = 60;
constexpr int kCommands = 6;            // one in each command interval, from rest
constexpr double kInsideRange = 0.9;    // share of the joints' ranges that arms start in
constexpr double kFarthest_m = 0.3;     // of a tip goal from where the tip is
constexpr double kFarthestTurn = 0.35;  // of a joint goal from where the joint is [rad]

class ArmAndTwin {
 public:
  explicit ArmAndTwin(std::uint64_t seed)
      : random_(seed), arm_(serial::micro::random_joints(serial::micro::table(), random_, kInsideRange)) {}

  bool enable() { return arm_.enable(); }

  // Gives the next candidate to both ends and, where they pass, to the arm; false when one refuses.
  bool send(const serial::Setpoint& setpoint) {
    const auto candidate = next_candidate(setpoint);
    prediction_ = predict(candidate);
    const auto telecommand =
        release_.release(candidate, judge_execution<SerialArm>(arm_.table(), candidate, prediction_),
                         judge_motion<SerialArm>(arm_.table(), candidate, prediction_));
    if (!telecommand) return false;
    released_ = {*telecommand};
    arm_.link.released.push(*telecommand);
    arm_.interval();
    return true;
  }

  Candidate<SerialArm> next_candidate(const serial::Setpoint& setpoint) {
    const auto interval = static_cast<std::uint64_t>(arm_.table().interval_ticks);
    return release_.candidate(setpoint, 1, arm_.link.image.value().next_tick + interval, interval);
  }
  Prediction<SerialArm> predict(const Candidate<SerialArm>& candidate) const {
    Prediction<SerialArm> prediction;
    Twin<SerialArm>::run(arm_.link.image.value(), released_, candidate, max_stop_ticks(arm_.table().tick_s),
                         prediction);
    return prediction;
  }

  serial::Setpoint tip_goal() {
    serial::Setpoint setpoint;
    setpoint.kind = CommandKind::kTip;
    setpoint.tip_in_base = arm_.now().tip_command;
    for (double& place_m : setpoint.tip_in_base.position_m) place_m += random_.uniform(-kFarthest_m, kFarthest_m);
    setpoint.tip_speed_m_s = random_.uniform(0.005, arm_.table().tip.speed_m_s);
    return setpoint;
  }
  serial::Setpoint joint_goal() {
    serial::Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    setpoint.joint_rad = near(arm_.table(), arm_.now().joint_command_rad, random_, kFarthestTurn);
    return setpoint;
  }

  // Lets the arm go through all that was predicted for the last candidate; how fast the tip was. The candidate's
  // interval begins where send() has left the arm.
  double follow(std::uint64_t seed) {
    double fastest_m_s = 0.0;
    for (const serial::Outputs& predicted : prediction_.ticks) {
      arm_.tick();
      EXPECT_EQ(serial::micro::numbers(predicted), serial::micro::numbers(arm_.now()))
          << "seed " << seed << ", tick " << arm_.now().tick;
      if (testing::Test::HasFailure()) return fastest_m_s;
      fastest_m_s = std::max(fastest_m_s, arm_.now().tip_speed_m_s);
    }
    return fastest_m_s;
  }

  bool draws_tip() { return random_.uniform(0.0, 1.0) < 0.5; }
  SimSerialArm& arm() { return arm_; }

 private:
  Random random_;
  SimSerialArm arm_;
  IssueStep<SerialArm> release_;
  std::vector<serial::Telecommand> released_;
  Prediction<SerialArm> prediction_;
};

// req:C1
TEST(TwinOfASerialArm, PredictsEveryNumberOfEveryTickOfWhatIsReleased) {
  int moved = 0;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const auto both = std::make_unique<ArmAndTwin>(seed);
    ASSERT_TRUE(both->enable()) << "seed " << seed;
    const serial::Setpoint goal = both->draws_tip() ? both->tip_goal() : both->joint_goal();
    bool released = true;
    for (int i = 0; i < kCommands && released; ++i) released = both->send(goal);
    if (!released) continue;  // nothing that was refused is promised
    const double fastest_m_s = both->follow(seed);
    ASSERT_FALSE(HasFailure());
    ASSERT_TRUE(both->arm().now().at_rest) << "the stop after the command is part of the prediction, seed " << seed;
    if (fastest_m_s > 1e-4) ++moved;
  }
  EXPECT_GT(moved, kSeeds / 2) << "most poses and goals have to be ones at which the arm moves";
}

TEST(TwinOfASerialArm, LeavesTheArmItselfAlone) {
  const auto both = std::make_unique<ArmAndTwin>(7);
  ASSERT_TRUE(both->enable());
  const serial::JointVector before = both->arm().now().joint_command_rad;
  EXPECT_GT(both->predict(both->next_candidate(both->joint_goal())).ticks.size(), 5u);
  both->arm().interval();
  EXPECT_EQ(both->arm().now().joint_command_rad, before);
}

}  // namespace
}  // namespace liana::verification
