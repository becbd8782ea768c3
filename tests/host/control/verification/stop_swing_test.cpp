// How an arm that swings is judged beside its own stop: what it does anyway is no reason to refuse, what is worse is.
#include <gtest/gtest.h>

#include <vector>

#include "host/control/verification/judge_simulated.hpp"
#include "host/control/verification/refusal_table.hpp"

namespace liana::verification {
namespace {

constexpr double kStep_s = 0.01;
constexpr std::size_t kMoments = 40;

// One segment, whose cables plan 40 N and whose first cable has less than its floor of them from `from_s` on.
class AnArmThatSwings : public testing::Test {
 protected:
  AnArmThatSwings() {
    rules_.table.segment_count = 1;
    rules_.table.segment[0].theta_limit_rad = 1.0;
    rules_.table.segment[0].cables = 3;
    rules_.table.tick_s = 0.004;
    rules_.table.limits.theta_rate_rad_s = 0.1;
    rules_.table.limits.tip_speed_m_s = 0.1;
    rules_.table.limits.tip_rate_rad_s = 0.3;
    rules_.table.tension.plan_N = 40.0;
    rules_.table.tension.floor_anywhere_N = 1.0;
    rules_.table.tension.alarm_N = 250.0;
    told_.rows_rad.resize(1);
    told_.interval_s = 0.02;
  }

  static simulation::Motion motion(double least_N, double speed_m_s, double from_s = 0.1) {
    simulation::Motion out;
    out.solved = true;
    out.min_passed_share.fill(1.0);
    out.distances.scene.distance_m = out.distances.self.distance_m = 1.0;
    for (std::size_t i = 0; i < kMoments; ++i) {
      simulation::Moment moment;
      moment.time_s = static_cast<double>(i) * kStep_s;
      moment.tension_N.fill(40.0);
      if (moment.time_s >= from_s && moment.time_s < from_s + 0.1) {
        moment.tension_N[0] = least_N;
        moment.node_speed_m_s[0] = speed_m_s;
      }
      out.moments.push_back(moment);
    }
    return out;
  }

  Refusal judged(const simulation::Motion& asked, const simulation::Motion* stop = nullptr) {
    return judge_simulated(rules_, told_, true, asked, too_near_, stop).code;
  }

  MotionRules rules_;
  simulation::JointSequence told_;
  TooNear too_near_;
};

TEST_F(AnArmThatSwings, IsRefusedWhateverItsStopWouldDoUnlessThatIsKnown) {
  EXPECT_EQ(judged(motion(7.0, 0.0)), Refusal::kNone);
  EXPECT_EQ(judged(motion(5.0, 0.0)), Refusal::kSwingTension);
  EXPECT_EQ(judged(motion(40.0, 0.114)), Refusal::kNone);
  EXPECT_EQ(judged(motion(40.0, 0.116)), Refusal::kTipSpeed);
  simulation::Motion unsolved = motion(-10.0, 0.2);
  unsolved.solved = false;
  EXPECT_EQ(judged(motion(5.0, 0.0), &unsolved), Refusal::kSwingTension);
}

// req:A20
TEST_F(AnArmThatSwings, MayDoWhatItDoesAnywayAndNothingWorse) {
  const simulation::Motion stop = motion(-5.0, 0.2);
  EXPECT_EQ(judged(motion(-5.0, 0.2), &stop), Refusal::kNone);
  EXPECT_EQ(judged(motion(-6.9, 0.2), &stop), Refusal::kNone) << "what two simulations differ by";
  EXPECT_EQ(judged(motion(-7.1, 0.2), &stop), Refusal::kSwingTension);
  EXPECT_EQ(judged(motion(5.0, 0.203), &stop), Refusal::kNone);
  EXPECT_EQ(judged(motion(5.0, 0.205), &stop), Refusal::kTipSpeed);
}

TEST_F(AnArmThatSwings, MayNotSwingAgainWhenItsStopIsOver) {
  const simulation::Motion stop = motion(-5.0, 0.2);
  EXPECT_EQ(judged(motion(-5.0, 0.0, 0.14), &stop), Refusal::kNone) << "the same swing, a little later";
  EXPECT_EQ(judged(motion(-5.0, 0.0, 0.16), &stop), Refusal::kSwingTension);
  EXPECT_EQ(judged(motion(40.0, 0.2, 0.16), &stop), Refusal::kTipSpeed);
}

TEST(SwingRefusals, AreThoseOfTensionAndSpeed) {
  for (const Refusal code : {Refusal::kSwingTension, Refusal::kTipSpeed, Refusal::kNodeSpeed, Refusal::kJointRate})
    EXPECT_TRUE(is_of_swing(code));
  for (const Refusal code : {Refusal::kNone, Refusal::kSceneContact, Refusal::kSelfContact, Refusal::kJointAngle,
                             Refusal::kModel, Refusal::kFixture, Refusal::kTension})
    EXPECT_FALSE(is_of_swing(code));
}

}  // namespace
}  // namespace liana::verification
