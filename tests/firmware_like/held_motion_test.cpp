// Any held variables at any values: while the tip moves, and while what is held changes.
#include <gtest/gtest.h>

#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "firmware_like/cable/motion/motion.hpp"
#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using namespace inverse_kinematics;

using zhu2022::bit;
using zhu2022::Random;

bool is_held(std::uint32_t mask, std::size_t k) { return ((mask >> k) & 1u) != 0; }

// What is held, and where.
struct Held {
  std::uint32_t mask = 0;
  ThetaVector rad{};
};

// An arm whose tip is steered with changing holds; the largest changes per tick are kept.
class HeldMotion : public testing::Test {
 protected:
  void start(const zhu2022::Degrees& theta_deg) {
    reset_motion(robot_, zhu2022::radians(theta_deg), state_);
    largest_change_ = largest_step_ = 0.0;
    asked_rate_ = ThetaVector{};
  }

  // Moves the target at `velocity_m_s` for some command intervals.
  void steer(
      const Vec3& velocity_m_s, const Held& held, std::int32_t intervals,
      const std::function<void()>& every_tick = [] {}) {
    const double interval_s = robot_.tick_s * robot_.interval_ticks;
    Setpoint target;
    target.kind = CommandKind::kTip;
    target.tip_in_base = state_.filter.pose;
    target.held_mask = held.mask;
    target.held_rad = held.rad;
    target.tip_speed_m_s = robot_.limits.tip_speed_m_s;
    for (std::int32_t i = 0; i < intervals; ++i) {
      target.tip_in_base.position_m = add(target.tip_in_base.position_m, scale(velocity_m_s, interval_s));
      accept_setpoint(robot_, target, state_);
      for (std::int32_t t = 0; t < robot_.interval_ticks; ++t) {
        tick();
        every_tick();
      }
    }
  }

  Pose tip() const { return forward_kinematics(robot_, state_.limiter.theta_rad).tip_in_base; }
  // Filtered target against the tip of the angles that the IK asks for, and of the command.
  double tip_error() const {
    return zhu2022::length(pose_error(state_.filter.pose, forward_kinematics(robot_, state_.ik_rad).tip_in_base));
  }
  double command_error() const { return zhu2022::length(pose_error(state_.filter.pose, tip())); }

  RobotParams robot_ = zhu2022::table();
  MotionState state_{};
  double largest_change_ = 0.0;  // of the rates that the IK asks for, from tick to tick [rad/s]
  double largest_step_ = 0.0;    // of the angles [rad]

 private:
  void tick() {
    const ThetaVector before = state_.ik_rad;
    advance_motion(robot_, cable_geometry(robot_, layout_, arm_trig(robot_, state_.limiter.theta_rad)), true, state_);
    for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
      const double step = state_.ik_rad[k] - before[k];
      largest_step_ = std::max(largest_step_, std::fabs(step));
      largest_change_ = std::max(largest_change_, std::fabs(step / robot_.tick_s - asked_rate_[k]));
      asked_rate_[k] = step / robot_.tick_s;
    }
  }

  CableLayout layout_ = cable_layout(robot_);
  ThetaVector asked_rate_{};
};

struct Hold {
  const char* what;
  std::vector<std::pair<std::size_t, double>> at_deg;  // theta (1-based), target
  bool near_singular;                                  // what stays free has to go many times as fast
};

const std::vector<Hold> kHolds{{"X5 at 7 deg", {{9, 7.0}}, false},
                               {"Y5", {{10, -4.0}}, false},
                               {"X4 and X5 at different targets", {{7, 2.0}, {9, -3.0}}, false},
                               {"X3, X4 and X5", {{5, 6.0}, {7, 4.0}, {9, 1.5}}, true},
                               {"X1 and Y3", {{1, -5.0}, {6, 13.0}}, false},
                               {"Y1, Y2, Y3 and Y4", {{2, -14.0}, {4, -9.0}, {6, 14.0}, {8, 14.0}}, false}};

Held held_by(const Hold& hold) {
  Held out;
  for (const auto& [theta, target_deg] : hold.at_deg) {
    out.mask |= bit(theta);
    out.rad[theta - 1] = target_deg * kDegree;
  }
  return out;
}

// Whatever is held goes to its target and then keeps its bits, while the tip is on its way.
// req:A38 req:A41
TEST_F(HeldMotion, AnyVariablesAtAnyValuesAreHeldExactlyWhileTheTipMoves) {
  for (const Hold& hold : kHolds) {
    start(zhu2022::kPanelEdge_deg);
    const Held held = held_by(hold);
    steer({}, held, 800);
    ASSERT_TRUE(state_.held_at_target) << hold.what;
    const Vec3 before = tip().position_m;
    steer({0.01, 0.0, 0.01}, held, 200, [&] {
      for (std::size_t k = 0; k < zhu2022::kThetas; ++k) {
        if (!is_held(held.mask, k)) continue;
        ASSERT_EQ(state_.ik_rad[k], held.rad[k]) << hold.what << ", theta " << k + 1;
        ASSERT_EQ(state_.limiter.theta_rad[k], held.rad[k]) << hold.what << ", theta " << k + 1;
      }
    });
    EXPECT_LE(tip_error(), 1e-6) << hold.what;
    EXPECT_GT(norm(subtract(tip().position_m, before)), 0.02) << hold.what;
  }
}

// Bumpless in position and rate. Two numbers per tick while the tip moves and the mask changes again and again:
// how far the angles that the IK asks for go, and how much their rates change. The limiter would hide a bump by leaving
// the path: it is not in these numbers.
// req:A38
TEST_F(HeldMotion, ChangingWhatIsHeldWhileTheTipMovesChangesRatesNoFasterThanTheJointsCan) {
  const double allowed = robot_.limits.theta_accel_rad_s2 * robot_.tick_s;
  for (const Hold& hold : kHolds) {
    if (hold.near_singular) continue;
    start(zhu2022::kPanelEdge_deg);
    const Held held = held_by(hold);
    for (const bool hold_now : {false, true, false, true, false}) {
      largest_change_ = largest_step_ = 0.0;
      steer({0.004, 0.0, 0.004}, hold_now ? held : Held{}, 400);
      EXPECT_LE(largest_change_, allowed) << hold.what << (hold_now ? ", held" : ", released");
      EXPECT_LE(largest_step_, robot_.limits.theta_rate_rad_s * robot_.tick_s) << hold.what;
    }
  }
}

// A released variable goes on from standing still: the freedom that it brings is taken up smoothly.
// req:A38
TEST_F(HeldMotion, ReleasingIsFarBelowWhatTheJointsCan) {
  const double allowed = robot_.limits.theta_accel_rad_s2 * robot_.tick_s;
  for (const Hold& hold : kHolds) {
    start(zhu2022::kPanelEdge_deg);
    steer({0.01, 0.0, 0.01}, held_by(hold), 1000);
    largest_change_ = 0.0;
    steer({0.01, 0.0, 0.01}, Held{}, 5);
    EXPECT_LE(largest_change_, 0.5 * allowed) << hold.what;
  }
}

// At 0 and elsewhere, while the tip stands still or goes on.
// req:A41
TEST_F(HeldMotion, ASegmentComesIntoThePlaneWhileTheTipStaysOrFollows) {
  for (const double speed_m_s : {0.0, 0.01}) {
    for (const double from_deg : {-2.0, 1.0, 9.0}) {
      for (const double to_deg : {0.0, 3.0}) {
        zhu2022::Degrees theta = zhu2022::kPanelEdge_deg;
        theta[8] = from_deg;
        start(theta);
        const Held held = held_by({"X5", {{9, to_deg}}, false});
        double largest = 0.0;
        steer(scale(Vec3{0.7, 0.0, 0.7}, speed_m_s), held, 1500, [&] { largest = std::max(largest, command_error()); });
        EXPECT_LE(largest, 5e-6) << from_deg << " to " << to_deg << " at " << speed_m_s;
        EXPECT_EQ(state_.limiter.theta_rad[8], to_deg * kDegree) << from_deg << " to " << to_deg;
      }
    }
  }
}

}  // namespace
}  // namespace liana::cable
