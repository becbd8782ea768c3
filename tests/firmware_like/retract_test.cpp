// The way out: a retract moves the arm, slowly, where faults forbid everything else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/firmware_like/extremes.hpp"
#include "tests/firmware_like/ideal_drives.hpp"
#include "tests/firmware_like/serial_rig.hpp"

namespace liana {
namespace {

// What both rigs are asked in the same words.
struct CableRig : cable::Rig {
  using Angles = cable::ThetaVector;
  const Angles& command() const { return out.theta_command_rad; }
  double rate_share() const {
    double most = 0.0;
    for (const double rate : out.theta_rate_rad_s) most = std::max(most, std::fabs(rate));
    return most / robot.limits.theta_rate_rad_s;
  }
  bool latch_hold() {
    Angles broken = command();
    broken[0] = kNan;
    tick(Request::kNone, release(joints(broken)));
    return cable::has_fault(out, FaultNumber::kCommandInvalid);
  }
};

struct SerialRig : serial::micro::Rig {
  using Angles = serial::JointVector;
  const Angles& command() const { return out.joint_command_rad; }
  double rate_share() const {
    double most = 0.0;
    for (std::size_t i = 0; i < robot.joints(); ++i)
      most = std::max(most, std::fabs(out.joint_rate_rad_s[i]) / robot.joint[i].rate_rad_s);
    return most;
  }
  bool latch_hold() {
    Angles broken = command();
    broken[0] = kNan;
    tick(Request::kNone, release(joints(broken)));
    return serial::micro::has_fault(out, FaultNumber::kCommandInvalid);
  }
};

template <class Rig>
class Retract : public testing::Test {
 protected:
  using Angles = typename Rig::Angles;

  void SetUp() override {
    rig.enable();
    start = goal = rig.command();
    goal[0] += 0.03;
    goal[1] -= 0.01;
  }
  auto command(CommandKind kind) {
    auto setpoint = rig.joints(goal);
    setpoint.kind = kind;
    return rig.release(setpoint);
  }
  // Ticks until the command stands at the goal; the fastest joint's share of its rate limit meanwhile.
  double run_to_goal() {
    double most = 0.0;
    for (std::int32_t i = 0; i < 5000 && rig.command() != goal; ++i) {
      rig.tick();
      most = std::max(most, rig.rate_share());
    }
    return most;
  }

  Rig rig;
  Angles start{}, goal{};
};

using BothArms = testing::Types<CableRig, SerialRig>;
TYPED_TEST_SUITE(Retract, BothArms);

TYPED_TEST(Retract, MovesTheArmToItsAnglesAtAQuarterOfTheRateWhileAHoldIsLatched) {
  auto& rig = this->rig;
  ASSERT_TRUE(rig.latch_hold());
  rig.tick(Request::kNone, this->command(CommandKind::kRetract));
  EXPECT_EQ(rig.out.active_sequence, rig.sequence);
  const double fastest = this->run_to_goal();
  EXPECT_EQ(rig.command(), this->goal);
  EXPECT_LE(fastest, kRetractRateShare * (1.0 + 1e-9));
  EXPECT_GE(fastest, 0.9 * kRetractRateShare) << "no slower than it has to be";
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
  EXPECT_EQ(rig.out.faults.count, 1) << "the fault stays until it is cleared, and nothing joined it";
}

TYPED_TEST(Retract, IsTheOnlyMotionThatAHoldLets) {
  auto& rig = this->rig;
  ASSERT_TRUE(rig.latch_hold());
  rig.tick(Request::kNone, this->command(CommandKind::kJoint));
  rig.run(50);
  EXPECT_EQ(rig.command(), this->start);
  EXPECT_EQ(rig.out.active_sequence, 0U);
}

TYPED_TEST(Retract, MovesAsSlowlyWithoutAFault) {
  auto& rig = this->rig;
  rig.tick(Request::kNone, this->command(CommandKind::kRetract));
  EXPECT_LE(this->run_to_goal(), kRetractRateShare * (1.0 + 1e-9));
  EXPECT_EQ(rig.command(), this->goal);
}

TYPED_TEST(Retract, EndsWithItsLifeAlongThePathAndStaysEnabled) {
  auto& rig = this->rig;
  ASSERT_TRUE(rig.latch_hold());
  auto setpoint = rig.joints(this->goal);
  setpoint.kind = CommandKind::kRetract;
  rig.tick(Request::kNone, rig.release(setpoint, 20));
  rig.run(19);
  EXPECT_FALSE(rig.out.at_rest);
  rig.run(200);
  EXPECT_TRUE(rig.out.at_rest);
  EXPECT_NE(rig.command(), this->goal);
  EXPECT_EQ(rig.out.state, OperatingState::kEnabled);
}

TYPED_TEST(Retract, EndsInAStopThatIsAskedFor) {
  auto& rig = this->rig;
  ASSERT_TRUE(rig.latch_hold());
  rig.tick(Request::kNone, this->command(CommandKind::kRetract));
  rig.run(50);
  rig.tick(Request::kStop);
  EXPECT_EQ(rig.out.state, OperatingState::kStopping);
  rig.run(300);
  EXPECT_EQ(rig.out.state, OperatingState::kFault);
}

}  // namespace
}  // namespace liana
