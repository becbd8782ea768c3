// Dynamic combination of degrees of freedom: any held variables at any values, equation 13, the ways that yaws leave, the switch point.
#include "firmware_like/motion/dof_split.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "firmware_like/motion/goal_ik.hpp"
#include "firmware_like/motion/motion.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana {
namespace {

using zhu2022::Random;

bool is_held(std::uint32_t mask, std::size_t k) { return ((mask >> k) & 1u) != 0; }

std::uint32_t bit(std::size_t theta) { return 1u << (theta - 1); }  // theta as the source counts them, from 1

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
      const Vec3& velocity_m_s, const Held& held, std::int32_t intervals, const std::function<void()>& every_tick = [] {}) {
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

  RobotTable robot_ = zhu2022::table();
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

// A38, A41: whatever is held goes to its target and then keeps its bits, while the tip is on its way.
TEST_F(HeldMotion, A38AnyVariablesAtAnyValuesAreHeldExactlyWhileTheTipMoves) {
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

// A38: bumpless in position and rate. Two numbers per tick while the tip moves and the mask changes again and again: how far the angles
// that the IK asks for go, and how much their rates change. The limiter would hide a bump by leaving the path: it is not in these numbers.
TEST_F(HeldMotion, A38ChangingWhatIsHeldWhileTheTipMovesChangesRatesNoFasterThanTheJointsCan) {
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
TEST_F(HeldMotion, A38ReleasingIsFarBelowWhatTheJointsCan) {
  const double allowed = robot_.limits.theta_accel_rad_s2 * robot_.tick_s;
  for (const Hold& hold : kHolds) {
    start(zhu2022::kPanelEdge_deg);
    steer({0.01, 0.0, 0.01}, held_by(hold), 1000);
    largest_change_ = 0.0;
    steer({0.01, 0.0, 0.01}, Held{}, 5);
    EXPECT_LE(largest_change_, 0.25 * allowed) << hold.what;
  }
}

// A39, A41: segment 5 comes into the plane, at 0 and elsewhere, while the tip stands still or goes on.
TEST_F(HeldMotion, A41ASegmentComesIntoThePlaneWhileTheTipStaysOrFollows) {
  for (const double speed_m_s : {0.0, 0.01}) {
    for (const double from_deg : {-2.0, 1.0, 9.0}) {
      for (const double to_deg : {0.0, 3.0}) {
        zhu2022::Degrees theta = zhu2022::kPanelEdge_deg;
        theta[8] = from_deg;
        start(theta);
        const Held held = held_by({"X5", {{9, to_deg}}, false});
        double largest = 0.0;
        steer(scale(Vec3{0.7, 0.0, 0.7}, speed_m_s), held, 1500, [&] { largest = std::max(largest, command_error()); });
        EXPECT_LE(largest, 1e-6) << from_deg << " to " << to_deg << " at " << speed_m_s;
        EXPECT_EQ(state_.limiter.theta_rad[8], to_deg * kDegree) << from_deg << " to " << to_deg;
      }
    }
  }
}

// ---- equation 13 ----------------------------------------------------------------------------------------------------------------------

double pose_difference(const Pose& a, const Pose& b) { return zhu2022::length(pose_error(a, b)); }

TEST(DofSplit, A39TheRootOfTheLastSegmentsFollowsFromTheTipAndTheirAngles) {
  for (const RobotTable& robot : {zhu2022::table(), zhu2022::uneven_table()}) {
    Random random(7);
    for (std::int32_t i = 0; i < 100; ++i) {
      const ThetaVector theta = random.theta(robot, 20.0);
      const ArmKinematics arm = forward_kinematics(robot, theta);
      for (std::int32_t segments = 0; segments <= robot.segment_count; ++segments) {
        PlanarPart part{segments, arm.tip_in_base, theta};
        // Nothing of S1 is known.
        for (std::int32_t k = 0; k < 2 * (robot.segment_count - segments); ++k) part.theta_rad[static_cast<std::size_t>(k)] = 0.3;
        const Pose& root = arm.node_in_base[static_cast<std::size_t>(robot.segment_count - segments)];
        ASSERT_LE(pose_difference(root_of(robot, part), root), 1e-13) << segments;
      }
    }
  }
}

// A39 to its end: S2's pose fixed, S1 solved for S2's root; together they put the tip where it should be.
TEST(DofSplit, A39SolvingTheFirstSegmentsForTheRootOfTheOthersPutsTheTipOnItsGoal) {
  const RobotTable robot = zhu2022::table();
  RobotTable first = robot;
  first.segment_count = 4;
  ThetaVector theta = zhu2022::radians(zhu2022::kPressRod_deg);
  const Pose goal = forward_kinematics(robot, theta).tip_in_base;
  for (const double pitch_deg : {0.0, 1.0, -2.0}) {
    theta[8] = pitch_deg * kDegree;
    GoalIkProblem problem;
    problem.tip_in_base = root_of(robot, {1, goal, theta});
    problem.from_rad = theta;
    const GoalIkResult solved = solve_goal(first, problem);
    ASSERT_TRUE(solved.converged) << pitch_deg;
    ThetaVector whole = solved.theta_rad;
    whole[8] = theta[8];
    whole[9] = theta[9];
    EXPECT_LE(pose_difference(forward_kinematics(robot, whole).tip_in_base, goal), 1e-6) << pitch_deg;
  }
}

TEST(DofSplit, PlanarPitchesAreThoseOfTheLastSegments) {
  const RobotTable robot = zhu2022::table();
  EXPECT_EQ(planar_pitches(robot, 0), 0u);
  EXPECT_EQ(planar_pitches(robot, 1), bit(9));
  EXPECT_EQ(planar_pitches(robot, 2), bit(7) | bit(9));
  EXPECT_EQ(planar_pitches(robot, 5), bit(1) | bit(3) | bit(5) | bit(7) | bit(9));
}

// ---- the ways that yaws leave ---------------------------------------------------------------------------------------------------------

// The slit of the scene panel_slit: its plane is that of the press rod's pose, its room the half gap of 50 mm less 30 mm of arm.
SlitMouth panel_slit() {
  const RobotTable robot = zhu2022::table();
  const Pose rod = forward_kinematics(robot, zhu2022::radians(zhu2022::kPressRod_deg)).tip_in_base;
  const Vec3 n = rotate(rod.quaternion, {0.0, 1.0, 0.0});
  const Vec3 along = subtract({1.0, 0.0, 0.0}, scale(n, n[0]));
  const Vec3 u = scale(along, 1.0 / norm(along));
  const Vec3 rod_u = rotate(conjugate(rod.quaternion), u);  // the rod's frame turned about its y (which is n) until its x is u
  const double angle = arc_tangent(-rod_u[2], rod_u[0]);
  const Quat frame = multiply(rod.quaternion, quaternion_of({0.0, angle, 0.0}));
  return {{add(scale(u, 1.75), scale(n, dot(n, rod.position_m))), frame}, 1.95, 0.02, 1.97};
}

TEST(DofSplit, TheFrameOfThePanelSlitHasItsAxes) {
  const SlitMouth mouth = panel_slit();
  const Vec3 n = rotate(mouth.frame_in_base.quaternion, {0.0, 1.0, 0.0});
  EXPECT_NEAR(n[0], 0.0036, 1e-4);
  EXPECT_NEAR(n[1], 0.9925, 1e-4);
  EXPECT_NEAR(rotate(mouth.frame_in_base.quaternion, {0.0, 0.0, 1.0})[0], 0.0, 1e-12);  // w is at right angles to base x
}

// Fitting judged anew, point by point along densely sampled links: inside the slit's depth everything within gap and width.
bool fits_by_sampling(const RobotTable& robot, const PlanarPart& part, const SlitMouth& mouth, double slack_m) {
  const LinkPoints links = link_points(robot, part.theta_rad);
  const Pose tip = forward_kinematics(robot, part.theta_rad).tip_in_base;
  const Pose shift = compose(part.tip_in_base, inverse(tip));
  const Pose to_mouth = compose(inverse(mouth.frame_in_base), shift);
  const std::int32_t first = links.count - 1 - 8 * part.segments;
  double s1_m = 0.0;
  for (std::int32_t m = 0; m < robot.segment_count - part.segments; ++m)
    s1_m += 8 * robot.segment[static_cast<std::size_t>(m)].module_length_m;
  const Vec3 root = compose(shift, {links.point_in_base[static_cast<std::size_t>(first)], {}}).position_m;
  if (norm(root) > s1_m + slack_m) return false;
  for (std::int32_t i = first; i + 1 < links.count; ++i) {
    const Vec3 a = compose(to_mouth, {links.point_in_base[static_cast<std::size_t>(i)], {}}).position_m;
    const Vec3 b = compose(to_mouth, {links.point_in_base[static_cast<std::size_t>(i + 1)], {}}).position_m;
    for (std::int32_t s = 0; s <= 100; ++s) {
      const Vec3 p = add(a, scale(subtract(b, a), s / 100.0));
      if (p[0] < slack_m || p[0] > mouth.depth_m - slack_m) continue;
      if (std::fabs(p[1]) > mouth.half_gap_m + slack_m || std::fabs(p[2]) > mouth.half_width_m + slack_m) return false;
    }
  }
  return true;
}

// Poses on the way from the panel edge to the rod, S2 of one and two segments: dense sampling agrees inside and outside the interval.
TEST(DofSplit, A39TheYawIntervalIsWhereS2IsReachableAndInsideTheSlit) {
  const RobotTable robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const ThetaVector rod = zhu2022::radians(zhu2022::kPressRod_deg);
  const Pose at_rod = forward_kinematics(robot, rod).tip_in_base;
  const Vec3 u = rotate(mouth.frame_in_base.quaternion, {1.0, 0.0, 0.0});
  std::int32_t bounded = 0;
  for (const std::int32_t segments : {1, 2}) {
    for (const double back_m : {0.0, 0.4, 0.8, 1.2}) {
      for (const double turn_rad : {0.0, 0.01}) {  // of the tip, out of the slit's plane
        PlanarPart part{segments, at_rod, rod};
        part.tip_in_base.position_m = subtract(part.tip_in_base.position_m, scale(u, back_m));
        part.tip_in_base.quaternion = multiply(part.tip_in_base.quaternion, quaternion_of({turn_rad, 0.0, turn_rad}));
        for (std::int32_t segment = 6 - segments; segment <= 5; ++segment) {
          const YawInterval interval = feasible_yaw(robot, part, mouth, segment);
          ASSERT_FALSE(interval.empty);
          const auto fits_at = [&](double yaw_rad, double slack_m) {
            PlanarPart trial = part;
            trial.theta_rad[static_cast<std::size_t>(2 * segment - 1)] = yaw_rad;
            return fits_by_sampling(robot, trial, mouth, slack_m);
          };
          for (std::int32_t i = 0; i <= 200; ++i) {
            const double yaw = interval.lowest_rad + i / 200.0 * (interval.highest_rad - interval.lowest_rad);
            ASSERT_TRUE(fits_at(yaw, 1e-3)) << segments << " " << back_m << " " << segment << " yaw " << yaw / kDegree;
          }
          const double limit = robot.segment[0].theta_limit_rad;
          for (const double beyond : {interval.lowest_rad - 1e-4, interval.highest_rad + 1e-4}) {
            if (std::fabs(beyond) > limit) continue;
            ++bounded;
            EXPECT_FALSE(fits_at(beyond, -1e-7)) << segments << " " << back_m << " " << segment << " yaw " << beyond / kDegree;
          }
        }
      }
    }
  }
  EXPECT_GT(bounded, 5);  // geometry, not only the joint limits, has bounded some
}

// By hand: S2 is one segment of two links of 0.1 m, its root 0.1 m behind its middle joint. The tip 1.7 m before the base, S1 1.5 m long:
// with the middle joint bent by yaw b, the root is at (1.7 - 0.1 - 0.1 cos b, 0, -0.1 sin b) turned only by b; 1.6 - 0.1 cos b > 1.5 unless
// b = 0: one point. With 5 mm more of S1 it is |b| <= acos of (1.6^2 + 0.01 - 1.505^2) / 0.32.
TEST(DofSplit, TheYawIntervalOfTwoLinksIsThatOfTheTriangle) {
  RobotTable robot = zhu2022::table();
  robot.segment_count = 2;
  robot.segment[0].modules = 14;
  robot.segment[1].modules = 2;
  for (const double more_m : {0.0005, 0.002}) {
    robot.segment[0].module_length_m = (1.5 + more_m) / 14.0;
    PlanarPart part{1, {{1.7, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, {}};
    const YawInterval interval = feasible_yaw(robot, part, {{{10.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 1.0, 1.0, 1.0}, 2);
    const double cosine = (1.6 * 1.6 + 0.01 - (1.5 + more_m) * (1.5 + more_m)) / (2.0 * 1.6 * 0.1);
    const double expected = std::acos(cosine);
    ASSERT_FALSE(interval.empty);
    ASSERT_LT(expected, robot.segment[1].theta_limit_rad);
    EXPECT_NEAR(interval.highest_rad, expected, 1e-8);
    EXPECT_NEAR(interval.lowest_rad, -expected, 1e-8);
  }
}

TEST(DofSplit, AYawThatDoesNotFitGivesTheIntervalNearestToIt) {
  const RobotTable robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const ThetaVector rod = zhu2022::radians(zhu2022::kPressRod_deg);
  PlanarPart part{2, forward_kinematics(robot, rod).tip_in_base, rod};
  const YawInterval interval = feasible_yaw(robot, part, mouth, 4);
  ASSERT_FALSE(interval.empty);
  ASSERT_LT(interval.highest_rad, robot.segment[3].theta_limit_rad);
  part.theta_rad[7] = robot.segment[3].theta_limit_rad;
  const YawInterval again = feasible_yaw(robot, part, mouth, 4);
  ASSERT_FALSE(again.empty);
  EXPECT_NEAR(again.highest_rad, interval.highest_rad, 1e-8);
}

TEST(DofSplit, TheYawIntervalIsEmptyWhereNoYawFitsAndForOtherSegments) {
  const RobotTable robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const ThetaVector rod = zhu2022::radians(zhu2022::kPressRod_deg);
  PlanarPart part{1, forward_kinematics(robot, rod).tip_in_base, rod};
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 4).empty);
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 6).empty);
  part.tip_in_base.position_m = {6.0, 0.0, 0.0};  // S1 cannot carry the root there
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 5).empty);
  part.tip_in_base = forward_kinematics(robot, rod).tip_in_base;
  part.tip_in_base.quaternion = multiply(part.tip_in_base.quaternion, quaternion_of({0.0, 0.0, 0.5}));  // stands across the slit
  EXPECT_TRUE(feasible_yaw(robot, part, mouth, 5).empty);
}

// ---- the switch point -----------------------------------------------------------------------------------------------------------------

// A straight arm along x into a slit whose mouth is at `mouth_m`.
std::int32_t planar_of_straight_arm(double mouth_m, const PlanarSwitch& when, std::int32_t before) {
  const RobotTable robot = zhu2022::table();
  const SlitMouth mouth{{{mouth_m, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, 2.0, 0.02, 1.0};
  return planar_segments(robot, link_points(robot, ThetaVector{}), mouth, when, before);
}

TEST(DofSplit, A40SegmentsBecomePlanarBeforeTheyReachTheMouth) {
  const PlanarSwitch when{0.2, 0.05};
  EXPECT_EQ(planar_of_straight_arm(4.25, when, 0), 0);  // the tip is at 4 m: 10+0
  EXPECT_EQ(planar_of_straight_arm(4.15, when, 0), 1);  // 9+1
  EXPECT_EQ(planar_of_straight_arm(3.45, when, 0), 1);  // segment 4 ends at 3.2 m
  EXPECT_EQ(planar_of_straight_arm(3.35, when, 1), 2);  // 8+2
  EXPECT_EQ(planar_of_straight_arm(2.55, when, 2), 3);
}

TEST(DofSplit, A40OnTheWayOutSegmentsAreReleasedFartherAwayThanTheyWereTaken) {
  const PlanarSwitch when{0.2, 0.05};
  for (const auto& [gap_m, entering, leaving] : {std::tuple{0.19, 1, 1}, {0.22, 0, 1}, {0.24, 0, 1}, {0.26, 0, 0}}) {
    EXPECT_EQ(planar_of_straight_arm(4.0 + gap_m, when, 0), entering) << gap_m;
    EXPECT_EQ(planar_of_straight_arm(4.0 + gap_m, when, 1), leaving) << gap_m;
  }
}

TEST(DofSplit, AnArmBesideOrBehindTheSlitNeedsNoPlanarSegments) {
  const RobotTable robot = zhu2022::table();
  const LinkPoints links = link_points(robot, ThetaVector{});
  const PlanarSwitch when{0.2, 0.05};
  const Quat level{1.0, 0.0, 0.0, 0.0};
  EXPECT_EQ(planar_segments(robot, links, {{{2.0, 0.5, 0.0}, level}, 2.0, 0.02, 1.0}, when, 0), 0);
  EXPECT_EQ(planar_segments(robot, links, {{{2.0, 0.0, 1.5}, level}, 2.0, 0.02, 1.0}, when, 0), 0);
  EXPECT_EQ(planar_segments(robot, links, {{{-3.0, 0.0, 0.0}, level}, 2.0, 0.02, 1.0}, when, 0), 0);
}

// The published poses: nothing planar at the panel edge, segments 4 and 5 at the press rod.
TEST(DofSplit, A40ThePublishedPosesGetTheirCombinations) {
  const RobotTable robot = zhu2022::table();
  const SlitMouth mouth = panel_slit();
  const auto planar_at = [&](const zhu2022::Degrees& theta_deg) {
    return planar_segments(robot, link_points(robot, zhu2022::radians(theta_deg)), mouth, PlanarSwitch{}, 0);
  };
  EXPECT_EQ(planar_at(zhu2022::kPrepare_deg), 0);
  EXPECT_EQ(planar_at(zhu2022::kPanelEdge_deg), 0);
  EXPECT_EQ(planar_at(zhu2022::kPressRod_deg), 2);  // segment 3 reaches 0.21 m into the mouth, and bends
}

}  // namespace
}  // namespace liana
