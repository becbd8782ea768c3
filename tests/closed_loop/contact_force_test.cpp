// How well the core knows the force that pushes the tip of the bench's arm, and what a dither does to arm and force.
#include <gtest/gtest.h>

#include <cmath>

#include "arm_under_control.hpp"
#include "firmware_like/cable/arm/dither.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr std::size_t kTip = 40;
constexpr double kRise_s = 1.5;

// A push on the tip that grows in kRise_s and stays.
class Pushed {
 public:
  Pushed(std::uint64_t seed, const char* pose, const Vec3& push_N)
      : arm({"nominal", seed, true, pose}), push_N_(push_N) {
    arm.boot();
  }

  void rest(double seconds, bool pushes) {
    time_s_ = 0.0;
    arm.hold(seconds, [&](ArmUnderControl&) { push(pushes ? time_s_ / kRise_s : 0.0); });
  }
  void move(double seconds, double begin_s) {
    time_s_ = 0.0;
    arm.move_joints(named_pose_rad("panel_edge"), seconds,
                    [&](ArmUnderControl&) { push((time_s_ - begin_s) / kRise_s); });
  }
  const cable::ContactStatus& told() const { return arm.outputs().contact; }
  // What is told lies within so many of its deviations of the truth, along every axis.
  double max_deviations() const {
    double most = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
      most = std::fmax(most, std::fabs(told().force_N[i] - push_N_[i]) / told().sd_N[i]);
    return most;
  }
  double error_N() const { return norm(subtract(told().force_N, push_N_)); }

  ArmUnderControl arm;

 private:
  void push(double share) {
    time_s_ += arm.table().tick_s;
    arm.plant().push(kTip, scale(push_N_, std::fmin(1.0, std::fmax(0.0, share))));
  }

  Vec3 push_N_;
  double time_s_ = 0.0;
};

// req:A29
TEST(ContactForce, APushOnAMovingArmIsKnownToThreeTenthsOfANewton) {
  Pushed push(31, "prepare", {0.9, -0.8, 1.5});
  push.rest(2.0, false);
  push.move(24.0, 9.0);
  measured("moving: error of 1.9 N", push.error_N(), "N");
  EXPECT_EQ(push.arm.outputs().faults.count, 0);
  EXPECT_EQ(push.told().seen, 7);
  EXPECT_LE(push.error_N(), 0.4);
}

// req:A29
TEST(ContactForce, APushOnARestingArmIsKnownWithinItsDeviationAndADitherMakesItSurer) {
  Pushed push(32, "prepare", {0.0, 0.8, -1.0});
  push.rest(1.0, false);
  push.move(40.0, 99.0);
  push.rest(2.0, false);
  push.rest(4.5, true);
  ASSERT_EQ(push.arm.outputs().faults.count, 0);
  EXPECT_EQ(push.told().state, cable::ContactState::kStuck);
  EXPECT_LE(push.error_N(), 1.5);
  EXPECT_LE(push.max_deviations(), 3.0);
  const Vec3 stuck_sd_N = push.told().sd_N;

  cable::Setpoint setpoint;
  setpoint.kind = CommandKind::kJoint;
  setpoint.joint_rad = push.arm.outputs().theta_command_rad;
  double least_N = 1e9, most_N = 0.0, largest_step_N = 0.0;
  cable::CableVector before_N = push.arm.outputs().tension_plan_N;
  const auto look = [&](ArmUnderControl& now) {
    for (std::size_t c = 0; c < 15; ++c) {
      const double plan_N = now.outputs().tension_plan_N[c];
      least_N = std::fmin(least_N, plan_N), most_N = std::fmax(most_N, plan_N);
      largest_step_N = std::fmax(largest_step_N, std::fabs(plan_N - before_N[c]));
      before_N[c] = plan_N;
    }
  };
  const auto decaying = [&setpoint](double share) {
    setpoint.dither_share = 0.2 * (1.0 - share);
    return setpoint;
  };
  push.arm.follow(4.0, decaying, look);
  push.arm.hold(cable::kDitherSettle_s + 1.0, look);
  measured("dithered: error of 1.3 N", push.error_N(), "N");
  EXPECT_EQ(push.arm.outputs().faults.count, 0);
  EXPECT_EQ(push.told().state, cable::ContactState::kDithered);
  EXPECT_GE(least_N, push.arm.table().tension.floor_motor_N);
  EXPECT_LE(most_N, push.arm.table().tension.ceiling_free_N);
  EXPECT_LE(largest_step_N, 2.0) << "of a cable's plan in a tick: nothing jumps";
  EXPECT_LE(push.error_N(), 0.6);
  EXPECT_LE(push.max_deviations(), 3.0);
  EXPECT_LT(norm(push.told().sd_N), norm(stuck_sd_N));  // of the whole force; one axis may be as unsure as before
}

// req:A29
TEST(ContactForce, AStraightArmDoesNotTellAForceAlongItself) {
  ArmUnderControl arm({"nominal", 3, false, "zero"});
  arm.boot();
  arm.hold(2.0);
  EXPECT_EQ(arm.outputs().contact.seen & 1u, 0u);
  EXPECT_GT(arm.outputs().contact.sd_N[0], cable::kContactSeen_N);
  EXPECT_EQ(arm.outputs().contact.force_N[0], 0.0) << "no number without its deviation";
}

}  // namespace
}  // namespace liana::closed_loop
