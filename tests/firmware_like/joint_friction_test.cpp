// Friction of joints as torque drives are told of it: found in slides, told at their ends.
#include "firmware_like/serial/joint_friction.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/firmware_like/micro_arm.hpp"

namespace liana::serial {
namespace {

constexpr double kDeclared_Nm = 8.0, kViscous_Nms = 40.0;

RobotParams rubbing_table() {
  RobotParams table = micro::table();
  table.torque.is_torque_controlled = 1;
  table.torque.coulomb_Nm = kDeclared_Nm;
  table.torque.viscous_Nms_per_rad = kViscous_Nms;
  return table;
}

class FrictionOfJoints : public testing::Test {
 protected:
  // Joint 2 turns at `rate` for so long while its gear gives `gear_Nm`, of which `moving_Nm` move links.
  void turn(double time_s, double rate_rad_s, double gear_Nm, double moving_Nm = 0.0) {
    JointVector rate{}, gear{}, moving{};
    rate[1] = rate_rad_s;
    gear[1] = gear_Nm;
    moving[1] = moving_Nm;
    const auto ticks = static_cast<int>(std::lround(time_s / table_.tick_s));
    for (int i = 0; i < ticks; ++i) find_friction(table_, rate, moving, gear, found_);
  }
  double told_Nm() const { return found_[1].coulomb_Nm; }

  RobotParams table_ = rubbing_table();
  FrictionFound found_ = declared_friction(table_);
};

TEST_F(FrictionOfJoints, IsTheDeclaredOneUntilASlideHasEnded) {
  turn(30.0, 0.01, 12.0 + kViscous_Nms * 0.01);
  EXPECT_EQ(told_Nm(), kDeclared_Nm) << "what followed at once would feed the base's swings";
  turn(0.1, 0.0, 3.0);
  EXPECT_NEAR(told_Nm(), 12.0, 1e-9);
  EXPECT_EQ(found_[0].coulomb_Nm, kDeclared_Nm) << "a joint that did not turn";
}

TEST_F(FrictionOfJoints, CountsWithoutWhatMovesTheLinksAndBothWaysAlike) {
  turn(30.0, -0.01, -12.0 - kViscous_Nms * 0.01 + 5.0, 5.0);
  turn(0.1, 0.0, 0.0);
  EXPECT_NEAR(told_Nm(), 12.0, 1e-9);
}

TEST_F(FrictionOfJoints, OfASwingIsItsMean) {
  for (int i = 0; i < 4; ++i) {
    turn(5.0, 0.01, 9.0 + kViscous_Nms * 0.01);
    turn(5.0, 0.01, 13.0 + kViscous_Nms * 0.01);
  }
  turn(0.1, 0.0, 0.0);
  EXPECT_NEAR(told_Nm(), 11.0, 0.2);
}

TEST_F(FrictionOfJoints, IsNotFoundInSlidesThatAreShortOrSlowOrTurnRound) {
  turn(kMinSlide_s, 0.01, 12.0);  // the first second does not count
  turn(0.1, 0.0, 0.0);
  turn(60.0, 0.9 * kSlides_rad_s, 12.0);
  turn(0.1, 0.0, 0.0);
  for (int i = 0; i < 10; ++i) turn(5.0, i % 2 == 0 ? 0.01 : -0.01, 12.0);
  turn(0.1, 0.0, 0.0);
  EXPECT_EQ(told_Nm(), kDeclared_Nm);
}

TEST_F(FrictionOfJoints, IsBelievedUpToThreeTimesTheDeclaredOneAndNeverBelowNone) {
  turn(30.0, 0.01, 500.0);
  turn(0.1, 0.0, 0.0);
  EXPECT_EQ(told_Nm(), kFrictionShare * kDeclared_Nm);
  turn(30.0, 0.01, -500.0);
  turn(0.1, 0.0, 0.0);
  EXPECT_EQ(told_Nm(), 0.0);
}

TEST_F(FrictionOfJoints, TurnsRoundWithTheRateWithoutAStep) {
  JointVector rate{};
  EXPECT_EQ(friction_Nm(table_, found_, rate)[1], 0.0);
  double before = -kDeclared_Nm;
  for (double r = -1e-3; r <= 1e-3; r += 1e-6) {
    rate[1] = r;
    const double torque = friction_Nm(table_, found_, rate)[1];
    EXPECT_NEAR(torque, before, 0.4);
    EXPECT_GE(torque * r, 0.0);
    before = torque;
  }
  rate[1] = 0.02;
  EXPECT_NEAR(friction_Nm(table_, found_, rate)[1], kDeclared_Nm + kViscous_Nms * 0.02, 1e-3);
}

}  // namespace
}  // namespace liana::serial
