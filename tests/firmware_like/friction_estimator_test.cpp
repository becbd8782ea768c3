// Friction found from the balance of torques, and what touches the body.
#include "firmware_like/cable/arm/friction_estimator.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/cable/arm/contact_detector.hpp"
#include "firmware_like/cable/arm/tension.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using std::size_t;

// An arm that sways about `prepare`, its cables in balance with the friction that it has, watched by a core that was
// told `declared_mu`.
class Swaying {
 public:
  Swaying(double true_mu, double declared_mu)
      : truth_(zhu2022::table(true_mu)), told_(zhu2022::table(declared_mu)), declared_mu_(declared_mu) {
    reset_friction_watch(declared_mu, state_);
    limits_ = make_torque_limits(told_);
    move(0.0);
    reset_slip(geometry_, slip_);
    reset_balance(geometry_, slip_, balance_);
  }

  // So many seconds, in motion or at rest; `push_N` on the body at the end of segment `node` (0: nowhere).
  void run(double time_s, bool moving = true, int node = 0, const Vec3& push_N = {}) {
    for (int tick = 0; tick < std::lround(time_s / told_.tick_s); ++tick, ++tick_) {
      if (moving) moved_s_ += told_.tick_s;
      move(moved_s_);
      if (static_cast<std::uint32_t>(tick_) % kFrictionTicks == 0) look(moving, node, push_N);
      planned_mu_before_ = told_.friction_mu;
      told_.friction_mu = plan_friction(declared_mu_, told_.friction_mu, told_.tick_s, state_);
      fastest_ = std::max(fastest_, std::fabs(told_.friction_mu - planned_mu_before_) / told_.tick_s);
    }
  }

  const FrictionEstimatorState& state() const { return state_; }
  const ContactDetectorState& contact() const { return contact_; }
  double planned_mu() const { return told_.friction_mu; }
  double fastest_change_1_s() const { return fastest_; }
  bool too_high() const { return is_friction_too_high(declared_mu_, state_); }

 private:
  void move(double time_s) {
    theta_ = zhu2022::radians(zhu2022::kPrepare_deg);
    for (size_t i = 0; i < zhu2022::kThetas; ++i)
      theta_[i] += 3.0 * kDegree * std::sin((0.3 + 0.05 * static_cast<double>(i)) * time_s + static_cast<double>(i));
    trig_ = arm_trig(told_, theta_);
    update_cable_geometry(told_, layout_, trig_, geometry_);
    advance_slip(layout_, geometry_, slip_);
  }

  // Torques that a push at a node asks of the segments up to it are taken up by the cables' balance.
  void look(bool moving, int node, const Vec3& push_N) {
    const TensionRatio true_ratio = tension_ratio(truth_, layout_, trig_, slip_);
    CableVector tension_N = plan_tension(truth_, geometry_, true_ratio, SegmentVector{}).motor_N;
    const ArmKinematics arm = forward_kinematics(told_, trig_);
    if (node > 0) add_push(true_ratio, arm, node, push_N, tension_N);
    const TensionRatio ratio = tension_ratio(told_, layout_, trig_, slip_);
    ThetaVector rate_rad_s{};
    rate_rad_s.fill(moving ? 0.01 : 0.0);
    const SegmentVector wrap_rad = cable_wraps(told_, trig_);
    const FrictionReadings now{geometry_,         ratio,      slip_, wrap_rad, tension_N,
                               told_.friction_mu, rate_rad_s, 0.0,   moving};
    const size_t axis = state_.axis;
    const bool is_round = watch_friction(told_, layout_, declared_mu_, now, state_);
    follow_slides(layout_, geometry_, ThetaVector{}, state_.mu + friction_sd(state_), balance_);
    balance_axis(told_, layout_, limits_,
                 {geometry_, wrap_rad, tension_N, rate_rad_s, state_.mu, friction_sd(state_), 0.0, 0.0, false}, axis,
                 balance_);
    if (!is_round) return;
    end_round(told_, limits_, balance_);
    watch_contact(told_, arm, balance_, {moving, false}, contact_);
    for (std::uint32_t place = 0; place < kPlaces * zhu2022::kCables / 3; ++place)
      try_place(told_, arm, place, contact_);
  }

  // From the tip to the root, the least change of each segment's cables that balances the push.
  void add_push(const TensionRatio& ratio, const ArmKinematics& arm, int node, const Vec3& push_N,
                CableVector& tension_N) const {
    CableVector more_N{};
    for (size_t j = zhu2022::kCables / 3; j-- > 0;) {
      double want[2], pp = 0.0, pq = 0.0, qq = 0.0;
      for (size_t a = 0; a < 2; ++a) {
        want[a] = dot(node_jacobian_column(arm, node, static_cast<std::int32_t>(2 * j + a)), push_N);
        for (size_t c = 3 * j + 3; c < zhu2022::kCables; ++c)
          want[a] -= geometry_.jacobian_m_rad[c][2 * j + a] * ratio[c][j] * more_N[c];
      }
      for (size_t c = 3 * j; c < 3 * j + 3; ++c) {
        const double p = geometry_.jacobian_m_rad[c][2 * j] * ratio[c][j],
                     q = geometry_.jacobian_m_rad[c][2 * j + 1] * ratio[c][j];
        pp += p * p, pq += p * q, qq += q * q;
      }
      const double det = pp * qq - pq * pq;
      for (size_t c = 3 * j; c < 3 * j + 3; ++c) {
        const double p = geometry_.jacobian_m_rad[c][2 * j] * ratio[c][j],
                     q = geometry_.jacobian_m_rad[c][2 * j + 1] * ratio[c][j];
        more_N[c] = (p * (want[0] * qq - want[1] * pq) + q * (want[1] * pp - want[0] * pq)) / det;
      }
    }
    for (size_t c = 0; c < zhu2022::kCables; ++c) tension_N[c] += more_N[c];
  }

  RobotParams truth_, told_;
  double declared_mu_;
  CableLayout layout_ = cable_layout(truth_);
  ThetaVector theta_{};
  ArmTrig trig_{};
  CableGeometry geometry_{};
  SlipState slip_{};
  FrictionEstimatorState state_{};
  TorqueLimits limits_{};
  TorqueBalance balance_{};
  ContactDetectorState contact_{};
  double moved_s_ = 0.0, planned_mu_before_ = 0.0, fastest_ = 0.0;
  int tick_ = 0;
};

TEST(FrictionWatch, WhatTheArmHasIsFoundWithinTenSecondsOfMotion) {
  for (const double mu : {0.0, 0.04, 0.05, 0.06, 0.12}) {
    Swaying arm(mu, 0.05);
    arm.run(10.0);
    EXPECT_NEAR(arm.state().mu, mu, 0.05 * mu + 0.002) << mu;
    EXPECT_LT(std::fabs(arm.state().mu - mu), 3.0 * friction_sd(arm.state())) << mu;
  }
}

TEST(FrictionWatch, TwiceOrHalfOfWhatWasDeclaredIsFlaggedWithinTenSecondsAndAFifthNever) {
  for (const double mu : {0.08, 0.10, 0.12, 0.0}) {
    Swaying arm(mu, 0.05);
    arm.run(10.0);
    EXPECT_TRUE(arm.state().flagged) << mu;
  }
  for (const double mu : {0.04, 0.05, 0.06}) {
    Swaying arm(mu, 0.05);
    for (int second = 0; second < 60; ++second) {
      arm.run(1.0);
      EXPECT_FALSE(arm.state().flagged) << mu << " after " << second;
    }
    EXPECT_EQ(arm.planned_mu(), 0.05) << "what was declared stays the plan's";
  }
}

TEST(FrictionWatch, ASegmentTurnsWhenTheRatesOfItsTwoAxesTogetherAreBeyondTheLimit) {
  const RobotParams robot = zhu2022::table();
  for (size_t k = 0; k < 10; ++k) {
    for (const double sign : {1.0, -1.0}) {
      ThetaVector rate_rad_s{};
      rate_rad_s[k] = sign * kSlidingRate_rad_s;
      EXPECT_EQ(turning_segments(robot, rate_rad_s), 0U);
      rate_rad_s[k] = std::nextafter(rate_rad_s[k], sign);
      EXPECT_EQ(turning_segments(robot, rate_rad_s), 1U << k / 2);
      rate_rad_s[k] = 0.6 * sign * kSlidingRate_rad_s;
      rate_rad_s[k ^ 1U] = -rate_rad_s[k];
      EXPECT_EQ(turning_segments(robot, rate_rad_s), 1U << k / 2) << "they do not cancel";
    }
  }
}

TEST(FrictionWatch, AnArmAtRestTeachesNothing) {
  Swaying arm(0.10, 0.05);
  arm.run(30.0, false);
  EXPECT_EQ(arm.state().mu, 0.05);
  EXPECT_FALSE(arm.state().flagged);
}

TEST(FrictionWatch, ThePlanFollowsSlowlyAndNeverBeyondWhatTensionsCanCarry) {
  Swaying arm(0.12, 0.05);
  arm.run(5.0);
  EXPECT_LT(arm.planned_mu(), 0.05 + 5.0 * kFrictionPlanRate_1_s);
  arm.run(30.0);
  EXPECT_NEAR(arm.planned_mu(), kFrictionPlanMost, 1e-9);
  EXPECT_LE(arm.fastest_change_1_s(), kFrictionPlanRate_1_s * (1.0 + 1e-6));
  EXPECT_FALSE(arm.too_high());
  Swaying dry(0.18, 0.05);
  dry.run(20.0);
  EXPECT_TRUE(dry.too_high()) << "nothing that the plan can do helps this arm";
}

TEST(ContactWatch, AFreeArmFeelsNothingWhateverItsFriction) {
  for (const double mu : {0.0, 0.05, 0.10}) {
    Swaying arm(mu, mu);
    for (int second = 0; second < 30; ++second) {
      arm.run(1.0);
      EXPECT_FALSE(is_in_contact(arm.contact())) << mu;
    }
  }
}

// req:A55
TEST(ContactWatch, APushOnTheBodyIsNoticedWithinThreeSecondsAndItsSegmentNamed) {
  for (const int node : {3, 4}) {
    Swaying arm(0.05, 0.05);
    arm.run(10.0);
    arm.run(3.0, true, node, Vec3{0.0, 5.0, 0.0});
    EXPECT_TRUE(is_in_contact(arm.contact())) << node;
    EXPECT_GE(arm.contact().segment + 1, node) << "the push is where two segments meet";
    EXPECT_LE(arm.contact().segment + 1, node + 1);
    EXPECT_GT(arm.contact().torque_Nm, 1.0) << node;
  }
}

// req:A29
TEST(ContactWatch, ALightPushAtTheTipIsWhatTheTipIsForAndAHeavyOneIsNot) {
  Swaying light(0.05, 0.05);
  light.run(10.0);
  light.run(5.0, true, 5, Vec3{0.0, 1.0, 0.0});
  EXPECT_FALSE(is_in_contact(light.contact()));
  EXPECT_NEAR(light.contact().force_N[1], 1.0, 2.0 * light.contact().sd_N[1]);
  Swaying heavy(0.05, 0.05);
  heavy.run(10.0);
  heavy.run(5.0, true, 5, Vec3{0.0, 6.0, 0.0});
  EXPECT_TRUE(is_in_contact(heavy.contact()));
}

// The joints stop within `stop_axes` looks at an axis of the ten of a round.
double stir_of_a_stop(size_t stop_axes) {
  const RobotParams table = zhu2022::table();
  const CableLayout layout = cable_layout(table);
  const TorqueLimits limits = make_torque_limits(table);
  const ArmTrig trig = arm_trig(table, zhu2022::radians(zhu2022::kPrepare_deg));
  const CableGeometry geometry = cable_geometry(table, layout, trig);
  const SegmentVector wrap_rad = cable_wraps(table, trig);
  CableVector tension_N;
  tension_N.fill(40.0);
  TorqueBalance balance;
  reset_balance(geometry, SlipState{}, balance);
  ThetaVector rate_rad_s;
  for (int round = 0; round < 2; ++round) {
    for (size_t axis = 0; axis < zhu2022::kThetas; ++axis) {
      const double stopped =
          round == 0 ? 0.0 : std::min(1.0, static_cast<double>(axis) / static_cast<double>(stop_axes));
      rate_rad_s.fill(0.01 * (1.0 - stopped));
      balance_axis(table, layout, limits, {geometry, wrap_rad, tension_N, rate_rad_s, 0.05, 0.01, 0.0, 0.0, false},
                   axis, balance);
    }
    if (round == 0) balance.stir = balance.peak = 0.0;
  }
  end_round(table, limits, balance);
  return balance.stir;
}

TEST(ContactWatch, AStopInATenthOfARoundStirsTheArmMoreThanALongOne) {
  EXPECT_NEAR(stir_of_a_stop(1) / stir_of_a_stop(8), 8.0, 1e-6);
}

}  // namespace
}  // namespace liana::cable
