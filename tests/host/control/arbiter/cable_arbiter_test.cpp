// The arbiter of the cable arm: what the owner and the operator ask for becomes one setpoint per interval.
#include "host/control/arbiter/cable_arbiter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "host/api/server/request_error.hpp"
#include "host/model/inverse_kinematics/goal_ik.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/message.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

class Arbitration : public testing::Test {
 protected:
  Arbitration() : table_(zhu2022::table()), arbiter_(table_) {
    now_.state = OperatingState::kEnabled;
    now_.at_rest = 1;
    now_.tension_measured_N.fill(table_.tension.plan_N);
    stand_at(zhu2022::radians(zhu2022::kPrepare_deg));
  }
  void stand_at(const ThetaVector& theta_rad) {
    now_.theta_command_rad = theta_rad;
    now_.tip_command = now_.tip_goal = forward_kinematics(table_, theta_rad).tip_in_base;
  }
  std::optional<Setpoint> next() { return arbiter_.next_setpoint(tick_ += 5, now_); }
  std::optional<Setpoint> steered(double x, bool pressed = true) {
    arbiter_.device().add(
        {.t_us = static_cast<std::int64_t>(tick_ * 4000 + 1), .deadman = pressed, .pose = {{x, 0.0, 0.0}}});
    return next();
  }
  void use_hand() {
    DeviceUse use;
    use.kind = device::Kind::kHandController;
    use.speed_m_s = 0.03;
    arbiter_.use_device(now_, use);
  }
  static std::string code_of(const std::function<void()>& request) {
    try {
      request();
    } catch (const api::RequestError& error) {
      return error.code();
    }
    return "accepted";
  }

  RobotParams table_;
  CableArbiter arbiter_;
  cable::Outputs now_{};
  std::uint64_t tick_ = 0;
};

TEST_F(Arbitration, WithoutARequestNothingIsAskedFor) { EXPECT_FALSE(next()); }

TEST_F(Arbitration, NothingMovesUnlessEnabledAndWithoutFault) {
  const ThetaVector goal{};
  now_.state = OperatingState::kDisabled;
  EXPECT_EQ(code_of([&] { arbiter_.move_joints(now_, goal, 0.03); }), "not_enabled");
  now_.faults.count = 1;
  EXPECT_EQ(code_of([&] { arbiter_.move_line(now_, now_.tip_command); }), "fault");
}

TEST_F(Arbitration, AJointMoveEndsAtItsGoalAndThenAsksForNothing) {
  ThetaVector goal = now_.theta_command_rad;
  goal[0] += 0.01;
  arbiter_.move_joints(now_, goal, 0.03);
  EXPECT_TRUE(arbiter_.is_busy());
  EXPECT_EQ(code_of([&] { arbiter_.move_joints(now_, goal, 0.03); }), "busy");
  ThetaVector last{};
  for (int i = 0; i < 2000 && arbiter_.is_busy(); ++i) {
    const auto setpoint = next();
    ASSERT_TRUE(setpoint);
    ASSERT_EQ(setpoint->kind, CommandKind::kJoint);
    last = setpoint->joint_rad;
  }
  EXPECT_FALSE(arbiter_.is_busy());
  EXPECT_EQ(last, goal);
  EXPECT_FALSE(next());
}

TEST_F(Arbitration, AReachedGoalIsNoLongerAskedForSoThatTheArmRests) {
  ThetaVector held{};
  now_.held_at_target = 1;
  arbiter_.hold_theta(now_, 1u << 8, held);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(next()) << "the request does not show in the report at once";
  now_.held_at_target = 0;
  EXPECT_TRUE(next()) << "the held variable is on its way";
  now_.held_at_target = 1;
  now_.tip_command.position_m[0] += 1e-3;
  EXPECT_TRUE(next()) << "the tip is away from its goal";
  now_.tip_command.position_m[0] -= 1e-3;
  EXPECT_FALSE(next());
}

TEST_F(Arbitration, ALineEndsAtItsGoalAndStaysThere) {
  Pose goal = now_.tip_command;
  goal.position_m[2] += 0.05;
  arbiter_.move_line(now_, goal);
  std::optional<Setpoint> setpoint = next();
  EXPECT_LT(norm(subtract(setpoint->tip_in_base.position_m, now_.tip_command.position_m)), 1e-3)
      << "starts slowly from where the tip is";
  for (int i = 0; i < 500; ++i) setpoint = next();
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->tip_in_base.position_m, goal.position_m);
}

// req:A9 req:A42
TEST_F(Arbitration, ADitherHoldsTheArmAndDecaysToNothingAndIsBusyMeanwhile) {
  now_.tension_plan_N.fill(60.0);
  now_.tension_measured_N.fill(60.0);
  arbiter_.dither(now_, 0.3, 4.0);
  EXPECT_EQ(code_of([&] { arbiter_.move_line(now_, now_.tip_command); }), "busy");
  double before = 0.31;
  int intervals = 0;
  for (; arbiter_.is_busy(); ++intervals) {
    const std::optional<Setpoint> setpoint = next();
    ASSERT_TRUE(setpoint);
    EXPECT_EQ(setpoint->joint_rad, now_.theta_command_rad);
    EXPECT_LT(setpoint->dither_share, before);
    EXPECT_GT(setpoint->dither_share, 0.0);
    before = setpoint->dither_share;
  }
  EXPECT_EQ(intervals, 200) << "4 s";
  EXPECT_FALSE(next());
  arbiter_.dither(now_, 0.3, 4.0);
  arbiter_.hold();
  EXPECT_FALSE(next()) << "a hold ends it";
}

TEST_F(Arbitration, ADitherIsRefusedWhereATensionWouldLeaveItsLimitsOrTheArmMoves) {
  now_.tension_plan_N.fill(60.0);
  now_.tension_measured_N.fill(60.0);
  now_.tension_plan_N[7] = 20.0;  // 30 % less is under the floor of 15 N
  EXPECT_EQ(code_of([&] { arbiter_.dither(now_, 0.3, 4.0); }), "refused");
  EXPECT_EQ(code_of([&] { arbiter_.dither(now_, 0.2, 4.0); }), "accepted");
  arbiter_.hold();
  now_.tension_plan_N[7] = 120.0;  // 30 % more is over the ceiling of 150 N
  EXPECT_EQ(code_of([&] { arbiter_.dither(now_, 0.3, 4.0); }), "refused");
  now_.tension_plan_N[7] = 60.0;
  now_.tension_measured_N[7] = 24.0;  // something pushes: 18 N less would leave 6 N
  EXPECT_EQ(code_of([&] { arbiter_.dither(now_, 0.3, 4.0); }), "refused");
  now_.at_rest = 0;
  EXPECT_EQ(code_of([&] { arbiter_.dither(now_, 0.1, 4.0); }), "busy");
}

TEST_F(Arbitration, APayloadIsToldToAnArmAtRestAndTravelsWithEverySetpoint) {
  now_.at_rest = 0;
  EXPECT_EQ(code_of([&] { arbiter_.carry(now_, {0.3, {0.01, 0.0, 0.0}}, {}); }), "busy");
  now_.at_rest = 1;
  EXPECT_EQ(code_of([&] { arbiter_.carry(now_, {0.3, {0.01, 0.0, 0.0}}, {}); }), "accepted");
  const auto stays = next();
  ASSERT_TRUE(stays) << "the arm is told at once";
  EXPECT_EQ(stays->tip_in_base.position_m, now_.tip_command.position_m);
  EXPECT_EQ(stays->payload.mass_kg, 0.3);
  EXPECT_EQ(stays->payload.center_in_tip_m, (Vec3{0.01, 0.0, 0.0}));
  arbiter_.hold();
  arbiter_.move_joints(now_, ThetaVector{}, 0.02);
  const auto moves = next();
  ASSERT_TRUE(moves);
  EXPECT_EQ(moves->payload.mass_kg, 0.3);
}

TEST_F(Arbitration, HeldVariablesAndShapeTravelWithTheTipGoal) {
  ThetaVector held{};
  arbiter_.hold_theta(now_, 1u << 8, held);
  std::array<NodeTarget, kMaxNodeTargets> nodes{};
  nodes[0] = {2, {0.1, 0.2, 0.3}, 2.0, 0.02};
  arbiter_.shape(now_, nodes, {}, false);
  const auto setpoint = next();
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->kind, CommandKind::kTip);
  EXPECT_EQ(setpoint->held_mask, 1u << 8);
  EXPECT_EQ(setpoint->node[0].node, 2);
  EXPECT_EQ(setpoint->tip_in_base.position_m, now_.tip_command.position_m) << "the tip stays";
}

TEST_F(Arbitration, ASearchLeadsTheNodesToTheBestShapeAndThenGivesTheTargetsThemselves) {
  NodeTargets nodes{};
  nodes[0] = {3, {0.7, 0.3, 0.3}, 1.0, 0.0};
  const inverse_kinematics::GoalIkResult best =
      inverse_kinematics::solve_goal(table_, {now_.tip_command, now_.theta_command_rad, 0, {}, nodes, {}});
  ASSERT_TRUE(best.converged);
  const ArmKinematics arm = forward_kinematics(table_, best.theta_rad);
  arbiter_.shape(now_, nodes, {}, true);
  now_.at_rest = 0;
  const auto lead = next();
  ASSERT_TRUE(lead);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(lead->node[i].node, static_cast<std::int32_t>(i) + 1);
    EXPECT_EQ(lead->node[i].position_m, arm.node_in_base[i + 1].position_m);
    now_.node_command_m[i] = arm.node_in_base[i + 1].position_m;
  }
  const auto target = next();
  ASSERT_TRUE(target);
  EXPECT_EQ(target->node[0].position_m, nodes[0].position_m);
  EXPECT_EQ(target->node[1].node, 0);
}

TEST_F(Arbitration, ASearchWhoseShapeCannotBeReachedEndsWhenTheArmHasComeToRest) {
  NodeTargets nodes{};
  nodes[0] = {3, {0.7, 0.3, 0.3}, 1.0, 0.0};
  arbiter_.shape(now_, nodes, {}, true);
  std::optional<Setpoint> setpoint;
  std::int32_t intervals = 0;
  do setpoint = next();
  while (setpoint && setpoint->node[1].node != 0 && ++intervals < 100);
  ASSERT_TRUE(setpoint);
  EXPECT_EQ(setpoint->node[0].position_m, nodes[0].position_m);
  EXPECT_GE(intervals, 5) << "a request needs some intervals to show in the arm's report";
}

TEST_F(Arbitration, InRealTimeTheArmHoldsUntilTheSearchHasItsResult) {
  CableArbiter arbiter(table_, {}, SearchResult::kWhenThere);
  NodeTargets nodes{};
  nodes[0] = {3, {0.7, 0.3, 0.3}, 1.0, 0.0};
  arbiter.shape(now_, nodes, {}, true);
  EXPECT_TRUE(arbiter.is_searching());
  std::optional<Setpoint> lead;
  for (int i = 0; i < 5000 && !lead; ++i) {
    EXPECT_TRUE(arbiter.is_searching());
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    lead = arbiter.next_setpoint(tick_ += 5, now_);
  }
  arbiter_.shape(now_, nodes, {}, true);
  const auto repeated = next();
  ASSERT_TRUE(lead && repeated);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(lead->node[i].position_m, repeated->node[i].position_m);
}

TEST_F(Arbitration, AHoldEndsASearchThatHasNoResultYet) {
  CableArbiter arbiter(table_, {}, SearchResult::kWhenThere);
  NodeTargets nodes{};
  nodes[0] = {3, {0.7, 0.3, 0.3}, 1.0, 0.0};
  arbiter.shape(now_, nodes, {}, true);
  arbiter.hold();
  EXPECT_FALSE(arbiter.is_searching());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_FALSE(arbiter.next_setpoint(tick_ += 5, now_));
  EXPECT_FALSE(arbiter.is_searching());
}

TEST_F(Arbitration, ASearchIsRefusedWhileTheArmMoves) {
  now_.at_rest = 0;
  EXPECT_EQ(code_of([&] { arbiter_.shape(now_, {}, {}, true); }), "busy");
}

TEST_F(Arbitration, ASearchAndAPlannedMoveExcludeEachOther) {
  NodeTargets nodes{};
  nodes[0] = {3, {0.7, 0.3, 0.3}, 1.0, 0.0};
  ThetaVector goal = now_.theta_command_rad;
  goal[0] += 0.1;
  arbiter_.move_joints(now_, goal, 0.03);
  EXPECT_EQ(code_of([&] { arbiter_.shape(now_, nodes, {}, true); }), "busy")
      << "the move has not begun to show in at_rest";
  arbiter_.hold();
  arbiter_.shape(now_, nodes, {}, true);
  EXPECT_EQ(code_of([&] { arbiter_.move_joints(now_, goal, 0.03); }), "busy");
  arbiter_.hold();
  EXPECT_EQ(code_of([&] { arbiter_.move_joints(now_, goal, 0.03); }), "accepted");
}

// req:A13
TEST_F(Arbitration, TheOperatorSteersFromWhereTheTipIsWithTheSpeedOfTheDevice) {
  use_hand();
  const auto first = steered(0.2);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->tip_in_base.position_m, now_.tip_command.position_m);
  EXPECT_EQ(first->tip_speed_m_s, 0.03);
  EXPECT_NEAR(steered(0.21)->tip_in_base.position_m[0], now_.tip_command.position_m[0] + 0.01, 1e-12);
}

TEST_F(Arbitration, LettingGoAsksForNothingSoThatTheArmStops) {
  use_hand();
  steered(0.2);
  EXPECT_FALSE(steered(0.21, false));
}

TEST_F(Arbitration, AMoveWhileTheOperatorSteersIsRefused) {
  use_hand();
  steered(0.2);
  EXPECT_EQ(code_of([&] { arbiter_.move_joints(now_, now_.theta_command_rad, 0.03); }), "busy");
}

TEST_F(Arbitration, AGripDuringAPlannedMoveStartsFromWhereTheMoveEnds) {
  use_hand();
  Pose goal = now_.tip_command;
  goal.position_m[0] += 0.01;
  arbiter_.move_line(now_, goal);
  while (arbiter_.is_busy()) steered(0.2);
  now_.tip_command = goal;
  EXPECT_EQ(steered(0.3)->tip_in_base.position_m, goal.position_m) << "hand motion during the move does not count";
}

TEST_F(Arbitration, ARefusalEndsThePlannedMove) {
  Pose goal = now_.tip_command;
  goal.position_m[0] += 0.1;
  arbiter_.move_line(now_, goal);
  next();
  arbiter_.refused();
  EXPECT_FALSE(arbiter_.is_busy());
  EXPECT_FALSE(next());
}

TEST_F(Arbitration, AMoveThatWouldSwingTooFarIsTriedAgainFromRestFourTimesMoreSlowlyAndAfterLongerWaits) {
  ThetaVector goal = now_.theta_command_rad;
  goal[0] += 0.05;
  arbiter_.move_joints(now_, goal, 0.03);
  double before_rad = 1.0;
  int before = -1;
  for (int tries = 0; tries < 5; ++tries) {
    std::optional<Setpoint> asked;
    int waited = 0;
    for (; !(asked = next()); ++waited) ASSERT_LT(waited, 1000);
    EXPECT_GT(waited, before);
    EXPECT_EQ(waited > 0, tries > 0);
    before = waited;
    for (int i = 0; i < 20; ++i) asked = next();
    const double moved_rad = asked->joint_rad[0] - now_.theta_command_rad[0];
    EXPECT_GT(moved_rad, 0.0);
    EXPECT_LT(moved_rad, before_rad);
    before_rad = moved_rad;
    EXPECT_EQ(arbiter_.refused("it would swing", true), tries < 4);
  }
  EXPECT_FALSE(arbiter_.is_busy());
}

TEST_F(Arbitration, HeldAnglesThatAreRefusedForTheirSwingAreAskedForAgainOnceTheArmRests) {
  ThetaVector held{};
  arbiter_.hold_theta(now_, 1u << 8, held);
  now_.held_at_target = 0;
  ASSERT_TRUE(next());
  EXPECT_TRUE(arbiter_.refused("it would swing", true));
  now_.at_rest = 0;
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(next()) << i;
  now_.at_rest = 1;
  for (int i = 0; i < 14; ++i) EXPECT_FALSE(next()) << i;
  EXPECT_TRUE(next());
  EXPECT_FALSE(arbiter_.refused("it would touch"));
  EXPECT_FALSE(next());
}

TEST_F(Arbitration, AJointMoveAskedForInMotionBeginsWhenTheArmHasStopped) {
  now_.at_rest = 0;
  ThetaVector goal = now_.theta_command_rad;
  goal[0] += 0.05;
  arbiter_.move_joints(now_, goal, 0.03);
  EXPECT_FALSE(next());
  now_.theta_command_rad[0] += 0.001;
  EXPECT_FALSE(next());
  now_.at_rest = 1;
  EXPECT_NEAR(next()->joint_rad[0], now_.theta_command_rad[0], 1e-6) << "from where it stands now";
}

TEST_F(Arbitration, AHandThatPushesOnAfterARefusalWaitsAndKeepsItsPlaceBesideTheTip) {
  use_hand();
  steered(0.2);
  const double asked_m = steered(0.25)->tip_in_base.position_m[0];
  arbiter_.refused();
  std::array<int, 3> waited{};
  for (int& intervals : waited) {
    std::optional<cable::Setpoint> asked;
    for (; !(asked = steered(0.26)); ++intervals) ASSERT_LT(intervals, 100);
    EXPECT_LE(asked->tip_in_base.position_m[0], asked_m + 0.01 + 1e-9);
    EXPECT_LT(asked->tip_speed_m_s, 0.4 * table_.limits.tip_speed_m_s) << "it begins slowly";
    arbiter_.refused();
  }
  EXPECT_EQ(waited, (std::array<int, 3>{9, 19, 39})) << "twice as long each time";
  for (int i = 0; i < 500; ++i) steered(0.26);
  EXPECT_NEAR(steered(0.26)->tip_in_base.position_m[0], asked_m + 0.01, 1e-9) << "nothing of the hand's way is lost";
}

// req:A20
TEST_F(Arbitration, WhatAHandIsRefusedIsAskedForMoreSlowlyInTheSameIntervalAndAtLastNotAtAll) {
  use_hand();
  steered(0.0);
  const double from_m = now_.tip_command.position_m[0];
  double before_m = steered(0.05)->tip_in_base.position_m[0] - from_m, before_m_s = 1.0;
  for (const bool is_last : {false, false, true}) {
    const auto slower = arbiter_.slower(now_, "sway_tension");
    ASSERT_TRUE(slower);
    const double way_m = slower->tip_in_base.position_m[0] - from_m;
    EXPECT_LT(way_m, before_m);
    EXPECT_EQ(way_m == 0.0, is_last);
    EXPECT_LT(slower->tip_speed_m_s, before_m_s);
    EXPECT_GT(slower->tip_speed_m_s, 0.0);
    EXPECT_STREQ(arbiter_.ease().limit, "sway_tension");
    before_m = way_m;
    before_m_s = slower->tip_speed_m_s;
  }
  EXPECT_EQ(arbiter_.ease().share, 0.0);
  EXPECT_FALSE(arbiter_.slower(now_, "sway_tension"));
  const auto next = steered(0.05);
  EXPECT_GT(next->tip_in_base.position_m[0], from_m) << "in the next interval it goes on";
  EXPECT_LT(arbiter_.ease().share, 0.2);
  steered(0.05, false);
  EXPECT_FALSE(arbiter_.slower(now_, "sway_tension")) << "nobody steers";
}

TEST_F(Arbitration, AHandThatPushesOnAgainstTheSameLimitHasARefusalThatStands) {
  use_hand();
  steered(0.2);
  steered(0.25);
  const auto refused_for = [&](const char* limit) {
    for (int i = 0; i < 1000 && !steered(0.26); ++i) continue;
    for (int i = 0; i < 10 && arbiter_.slower(now_, limit); ++i) continue;
    const bool stands = arbiter_.stands_refused();
    arbiter_.refused();
    return stands;
  };
  EXPECT_FALSE(refused_for("self_contact"));
  EXPECT_TRUE(refused_for("self_contact"));
  EXPECT_FALSE(refused_for("joint_angle"));
  EXPECT_TRUE(refused_for("joint_angle"));
  for (int i = 0; i < 1000; ++i) steered(0.26);
  EXPECT_FALSE(refused_for("joint_angle")) << "it is forgotten";
}

// The shape's own motion in the null space of the tip is no business of a hand that leads the arm off itself.
TEST_F(Arbitration, AHandAtAnArmThatWouldTouchItselfLeadsTheLastSegmentsAloneForASecond) {
  use_hand();
  steered(0.0);
  EXPECT_EQ(steered(0.05)->held_mask, 0u);
  EXPECT_EQ(arbiter_.slower(now_, "sway_tension")->held_mask, 0u);
  const auto kept = arbiter_.slower(now_, "self_contact");
  EXPECT_EQ(kept->held_mask, 0xFu) << "six angles are left for the tip";
  EXPECT_EQ(kept->held_rad, now_.theta_command_rad);
  int intervals = 0;
  while (steered(0.05)->held_mask == 0xFu) ASSERT_LT(++intervals, 100);
  EXPECT_EQ(intervals, 49);
  arbiter_.slower(now_, "self_contact");
  steered(0.05, false);
  steered(0.0);
  EXPECT_EQ(steered(0.05)->held_mask, 0u) << "who has let go begins anew";
}

TEST_F(Arbitration, AHandWhoseWayBackIsRefusedWaitsNoLongerThanAtFirst) {
  use_hand();
  steered(0.2);
  steered(0.25);
  const auto waited = [&](double x) {
    arbiter_.refused();
    for (int intervals = 0; intervals < 1000; ++intervals)
      if (steered(x + 1e-5 * (intervals % 2))) return intervals;  // a hand trembles
    return 1000;
  };
  EXPECT_EQ(waited(0.25), 9);
  EXPECT_EQ(waited(0.25), 19);
  for (double x = 0.24; x > 0.15; x -= 0.01) steered(x);
  EXPECT_TRUE(steered(0.15)) << "it has turned back";
  EXPECT_EQ(waited(0.15), 9);
  EXPECT_EQ(waited(0.15), 19);
}

TEST_F(Arbitration, AHandThatTurnsBackAfterARefusalIsFollowedAtOnce) {
  use_hand();
  steered(0.2);
  steered(0.25);
  arbiter_.refused();
  EXPECT_FALSE(steered(0.25));
  for (const double x : {0.24, 0.23, 0.22}) EXPECT_FALSE(steered(x)) << x;
  EXPECT_TRUE(steered(0.21)) << "by most of the way that was refused";
}

// Table 2 of the source: vr handles for free space, the hand controller for the slit.
// Live, but not under a hand that steers: 0.05 m of it would mean another place of the tip at once.
// req:A28
TEST_F(Arbitration, TheMappingOfTheDeviceInUseChangesOnlyWhileTheDeadmanIsOpen) {
  use_hand();
  ASSERT_TRUE(steered(0.0));
  const Pose before = steered(0.05)->tip_in_base;
  DeviceUse other = arbiter_.device().in_use();
  for (const ClutchMapping mapping :
       {ClutchMapping{2.0, 1.0}, ClutchMapping{1.0, 0.5}, ClutchMapping{1.0, 1.0, TeleopFrame::kCamera}}) {
    other.mapping = mapping;
    EXPECT_EQ(code_of([&] { arbiter_.use_device(now_, other); }), "busy");
  }
  EXPECT_EQ(arbiter_.device().in_use().mapping, ClutchMapping{});
  EXPECT_EQ(steered(0.05)->tip_in_base.position_m, before.position_m) << "nothing has come of it";
  steered(0.05, false);
  EXPECT_EQ(code_of([&] { arbiter_.use_device(now_, other); }), "accepted");
  EXPECT_EQ(steered(0.05)->tip_in_base.position_m, now_.tip_command.position_m) << "from where the tip is";
}

TEST_F(Arbitration, AnotherDeviceOrNoneTakesOverFromAHandThatSteers) {
  for (const device::Kind kind : {device::Kind::kVrControllers, device::Kind::kNone}) {
    use_hand();
    ASSERT_TRUE(steered(0.0));
    DeviceUse other;
    other.kind = kind;
    other.mapping.scale = 2.0;
    EXPECT_EQ(code_of([&] { arbiter_.use_device(now_, other); }), "accepted");
    EXPECT_FALSE(arbiter_.device().engaged());
  }
}

// req:A9
TEST_F(Arbitration, AHandIsToldOfAnArmThatStaysBehindAndAsksForLessSpeed) {
  const cable::ArmKinematics arm = forward_kinematics(table_, now_.theta_command_rad);
  std::size_t k = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table_.theta_count()); ++i) {
    if (std::fabs(arm.tip_jacobian.linear[i][0]) > std::fabs(arm.tip_jacobian.linear[k][0])) k = i;
  }
  now_.theta_measured_rad = now_.theta_command_rad;
  use_hand();
  for (int i = 0; i < 5; ++i) steered(0.0, false);
  double hand_m = 0.0;
  const auto led = [&] { return steered(hand_m += 5e-4); };
  for (int i = 0; i < 5; ++i) led();
  const double fast_m_s = led()->tip_speed_m_s;
  EXPECT_NE(arbiter_.ease().cause, virtual_fixtures::SlowdownCause::kLag);
  double asked_m_s = fast_m_s;
  for (int i = 0; i < 60; ++i) {  // 40 mm behind, on the way
    if (i < 40) now_.theta_measured_rad[k] -= 1e-3 / arm.tip_jacobian.linear[k][0];
    asked_m_s = led()->tip_speed_m_s;
  }
  EXPECT_LT(asked_m_s, 0.5 * fast_m_s);
  EXPECT_EQ(arbiter_.ease().cause, virtual_fixtures::SlowdownCause::kLag);
  EXPECT_LT(arbiter_.ease().share, 0.3);
}

// req:A9
TEST_F(Arbitration, AHandWaitsForACableThatIsOnItsWayToSlackAndIsToldWhy) {
  use_hand();
  for (int i = 0; i < 5; ++i) steered(0.0, false);
  for (int i = 0; i < 5; ++i) steered(5e-4 * i);
  const double fast_m_s = steered(5e-3)->tip_speed_m_s;
  now_.tension_measured_N[7] = table_.tension.floor_motor_N - 2.0;
  double slow_m_s = fast_m_s;
  for (int i = 0; i < 60; ++i) slow_m_s = steered(5e-3)->tip_speed_m_s;
  EXPECT_LT(slow_m_s, 0.6 * fast_m_s);
  EXPECT_EQ(arbiter_.ease().cause, virtual_fixtures::SlowdownCause::kTension);
}

class AtTheSlit : public Arbitration {
 protected:
  AtTheSlit() {
    slit_.u_axis = {1.0, 0.0, 0.0};
    slit_.normal = {0.0, 1.0, 0.0};
    slit_.offset_m = now_.tip_command.position_m[1];
    slit_.half_gap_m = 0.05;
    slit_.end_u_m = 10.0;
    slit_.mouth_u_m = now_.tip_command.position_m[0] + 0.01;
  }
  static DeviceUse use(device::Kind kind, bool anywhere = false) {
    DeviceUse use;
    use.kind = kind;
    use.speed_m_s = 0.03;
    use.anywhere = anywhere;
    return use;
  }
  void right_hand(CableArbiter& arbiter, double x) {
    arbiter.device().add(
        {.t_us = static_cast<std::int64_t>(tick_ * 4000 + 1), .deadman = true, .pose = {{x, 0.0, 0.0}}});
  }
  config::SceneSlit slit_;
};

// req:A33
TEST_F(AtTheSlit, VrIsRefusedInsideUnlessItIsToSteerAnywhereAndTheHandControllerIsNot) {
  slit_.mouth_u_m -= 0.02;
  CableArbiter arbiter(table_, SpeedZone(slit_, 0.03));
  EXPECT_EQ(code_of([&] { arbiter.use_device(now_, use(device::Kind::kVrControllers)); }), "refused");
  EXPECT_EQ(arbiter.device().in_use().kind, device::Kind::kNone);
  EXPECT_EQ(code_of([&] { arbiter.use_device(now_, use(device::Kind::kVrControllers, true)); }), "accepted");
  EXPECT_EQ(code_of([&] { arbiter.use_device(now_, use(device::Kind::kHandController)); }), "accepted");
  EXPECT_EQ(code_of([&] { arbiter.use_device(now_, use(device::Kind::kNone)); }), "accepted");
}

// req:A33
TEST_F(AtTheSlit, VrThatSteersIntoItIsLetGoAtTheMouth) {
  CableArbiter arbiter(table_, SpeedZone(slit_, 0.03));
  arbiter.use_device(now_, use(device::Kind::kVrControllers));
  for (int i = 0; i < 3; ++i) {
    right_hand(arbiter, 0.1 * i);
    EXPECT_TRUE(arbiter.next_setpoint(tick_ += 5, now_)) << "in front of it";
  }
  now_.tip_command.position_m[0] += 0.02;
  for (int i = 0; i < 3; ++i) {
    right_hand(arbiter, 0.5);
    EXPECT_FALSE(arbiter.next_setpoint(tick_ += 5, now_)) << "inside";
  }
  EXPECT_FALSE(arbiter.device().engaged());
  EXPECT_STREQ(arbiter.device().reason(), "in_slit");
}

TEST_F(AtTheSlit, ATipThatComesOutOfItIsLetGoFasterSlowly) {
  CableArbiter arbiter(table_, SpeedZone(slit_, 0.03));
  Pose goal = now_.tip_command;
  goal.position_m[0] -= 1.5;  // it has run ahead of the tip
  arbiter.servo_tip(now_, goal);
  double asked_m_s = 0.0;
  for (int i = 0; i < 200; ++i) {  // 4 s before the mouth, on the way
    now_.tip_command.position_m[0] -= 2e-4;
    asked_m_s = arbiter.next_setpoint(tick_ += 5, now_)->tip_speed_m_s;
  }
  ASSERT_NEAR(asked_m_s, 0.0261, 1e-12);
  now_.tip_command.position_m[0] -= 0.2;
  const auto go_on = [&] {
    now_.tip_command.position_m[0] -= 0.02 * asked_m_s;
    return arbiter.next_setpoint(tick_ += 5, now_)->tip_speed_m_s;
  };
  for (int i = 1; i <= 440; ++i) {
    const double before_m_s = asked_m_s;
    asked_m_s = go_on();
    EXPECT_NEAR(asked_m_s - before_m_s, 0.006 * 0.02, 1e-12) << i;
  }
  for (int i = 0; i < 100; ++i) asked_m_s = go_on();
  EXPECT_DOUBLE_EQ(asked_m_s, kGoalSpeedShare * table_.limits.tip_speed_m_s);
}

TEST_F(Arbitration, ATipAfterADistantGoalSpeedsUpAsItMaySwingAndSlowsDownAtOnce) {
  next();
  Pose goal = now_.tip_command;
  goal.position_m[0] -= 0.5;
  arbiter_.servo_tip(now_, goal);
  double asked_m_s = 0.0;
  int intervals = 0;
  for (; asked_m_s < kGoalSpeedShare * table_.limits.tip_speed_m_s && intervals < 100; ++intervals) {
    now_.tip_command.position_m[0] -= 0.02 * asked_m_s;
    asked_m_s = next()->tip_speed_m_s;
  }
  const double accel_m_s2 = kGoalAccelShare * table_.limits.tip_accel_m_s2;
  EXPECT_NEAR(intervals * 0.02, asked_m_s / accel_m_s2, 0.25);
  arbiter_.cap_tip_speed(0.015);
  EXPECT_DOUBLE_EQ(next()->tip_speed_m_s, 0.015);
  arbiter_.cap_tip_speed(table_.limits.tip_speed_m_s);
  EXPECT_LT(next()->tip_speed_m_s, 0.02);
}

// A way in along theta 1: 20 intervals of 1 mrad each.
class RetractRequest : public Arbitration {
 protected:
  static constexpr double kStep_rad = 0.001;

  void go_in() {
    for (int i = 0; i < 20; ++i) {
      now_.theta_command_rad[0] += kStep_rad;
      next();
    }
  }
  // The arm follows each setpoint of the way back until there is none; how many there were.
  int follow() {
    int count = 0;
    for (auto setpoint = next(); setpoint; setpoint = next(), ++count) {
      EXPECT_EQ(setpoint->kind, CommandKind::kJoint);
      const double step = setpoint->joint_rad[0] - now_.theta_command_rad[0];
      EXPECT_LE(step, 0.0);
      EXPECT_GE(step, -1.0001 * kWayBackPace * kStep_rad) << "slower than the way in";
      now_.theta_command_rad = setpoint->joint_rad;
    }
    return count;
  }
  void wait_for_rest(int intervals = 3) {
    for (int i = 0; i < intervals; ++i) EXPECT_FALSE(next());
  }

  const double start_ = now_.theta_command_rad[0] + kStep_rad;
};

TEST_F(RetractRequest, LeadsBackAlongWhatWasCommandedAndSaysSo) {
  EXPECT_EQ(code_of([&] { arbiter_.retract(now_, 0); }), "refused") << "nothing was stored yet";
  go_in();
  arbiter_.retract(now_, 0);
  wait_for_rest();
  EXPECT_GT(follow(), 25);
  EXPECT_EQ(now_.theta_command_rad[0], start_);
  EXPECT_FALSE(arbiter_.is_busy());
  EXPECT_TRUE(arbiter_.has_retracted());
}

TEST_F(RetractRequest, BeginsWhereTheArmHasComeToRest) {
  go_in();
  now_.at_rest = 0;
  arbiter_.retract(now_, 0);
  for (int i = 0; i < 10; ++i) {
    EXPECT_FALSE(next()) << "the arm stops along its path first";
    EXPECT_TRUE(arbiter_.is_busy());
    now_.theta_command_rad[0] += 0.1 * kStep_rad;
  }
  now_.at_rest = 1;
  wait_for_rest();
  const double rest = now_.theta_command_rad[0];
  EXPECT_NEAR(next()->joint_rad[0], rest, 0.01 * kStep_rad);
  follow();
  EXPECT_EQ(now_.theta_command_rad[0], start_);
}

TEST_F(RetractRequest, EndsWhereTheCommandStoodAtTheTickAskedFor) {
  for (int i = 0; i < 20; ++i) {
    now_.theta_command_rad[0] += kStep_rad;
    next();
  }
  arbiter_.retract(now_, tick_ - 45);  // ten intervals before
  wait_for_rest();
  follow();
  EXPECT_NEAR(now_.theta_command_rad[0], start_ + 10 * kStep_rad, 1e-12);
}

// An arm at rest may swing on; what is refused because of that has to wait until it has died away.
TEST_F(RetractRequest, StartsAgainFromALongerRestEachTimeItIsRefusedAndGivesUpInTheEnd) {
  go_in();
  arbiter_.retract(now_, 0);
  int refusals = 0;
  for (; arbiter_.is_busy() && refusals < 100; ++refusals) {
    wait_for_rest(std::min(3 << refusals, 100));
    EXPECT_TRUE(next());
    arbiter_.refused();
  }
  EXPECT_EQ(refusals, 10);
  EXPECT_FALSE(arbiter_.has_retracted());
  EXPECT_FALSE(next());
}

TEST_F(RetractRequest, GoesAllTheWayAfterARefusal) {
  go_in();
  arbiter_.retract(now_, 0);
  wait_for_rest();
  for (int i = 0; i < 10; ++i) now_.theta_command_rad = next()->joint_rad;
  next();
  arbiter_.refused();
  wait_for_rest(6);
  follow();
  EXPECT_EQ(now_.theta_command_rad[0], start_);
  EXPECT_TRUE(arbiter_.has_retracted());
}

// A stop goes on along the path: what it passes is behind the arm, and no cusp of the path.
TEST_F(RetractRequest, AskedForAgainGoesOnFromWhereTheStopEnds) {
  go_in();
  arbiter_.retract(now_, 0);
  wait_for_rest();
  for (int i = 0; i < 10; ++i) now_.theta_command_rad = next()->joint_rad;
  const double at_rad = now_.theta_command_rad[0];
  arbiter_.retract(now_, 0);
  now_.at_rest = 0;
  for (int i = 0; i < 3; ++i) {
    now_.theta_command_rad[0] -= 0.3 * kStep_rad;
    EXPECT_FALSE(next());
  }
  now_.at_rest = 1;
  wait_for_rest();
  for (std::optional<Setpoint> asked = next(); asked; asked = next()) {
    EXPECT_LT(asked->joint_rad[0], at_rad - 0.8 * kStep_rad) << "it does not go back to where the stop began";
    now_.theta_command_rad = asked->joint_rad;
  }
  EXPECT_EQ(now_.theta_command_rad[0], start_);
}

TEST_F(RetractRequest, SaysWhatItIsDoingAndHowMuchIsLeft) {
  EXPECT_EQ(arbiter_.retract_state().phase, RetractPhase::kNone);
  go_in();
  arbiter_.retract(now_, 0);
  EXPECT_EQ(arbiter_.retract_state().phase, RetractPhase::kStopping);
  EXPECT_EQ(arbiter_.retract_state().points_left, 19u);
  EXPECT_EQ(arbiter_.retract_state().points, 19u);
  wait_for_rest();
  for (int i = 0; i < 40; ++i) now_.theta_command_rad = next()->joint_rad;
  EXPECT_EQ(arbiter_.retract_state().phase, RetractPhase::kBack);
  EXPECT_LT(arbiter_.retract_state().points_left, 19u);
  follow();
  EXPECT_EQ(arbiter_.retract_state().phase, RetractPhase::kDone);
  EXPECT_EQ(arbiter_.retract_state().points_left, 0u);
  EXPECT_EQ(arbiter_.retract_state().points, 19u);
  const auto news = arbiter_.take_way_news();
  ASSERT_EQ(news.size(), 2u);
  EXPECT_EQ(news[0].what, event::RetractEvent::kBegins);
  EXPECT_EQ(news[0].points, 19u);
  EXPECT_EQ(news[1].what, event::RetractEvent::kArrives);
}

TEST_F(RetractRequest, IsNoLongerRetractedOnceTheArmHasMovedOn) {
  go_in();
  arbiter_.retract(now_, 0);
  wait_for_rest();
  follow();
  next();
  EXPECT_TRUE(arbiter_.has_retracted());
  go_in();
  EXPECT_FALSE(arbiter_.has_retracted());
}

TEST_F(RetractRequest, IsNotBackBeforeTheArmIsAtRestThere) {
  go_in();
  arbiter_.retract(now_, 0);
  wait_for_rest();
  for (int i = 0; i < 200; ++i) {
    now_.at_rest = 0;
    const auto setpoint = next();
    ASSERT_TRUE(setpoint);
    now_.theta_command_rad = setpoint->joint_rad;
  }
  EXPECT_EQ(now_.theta_command_rad[0], start_);
  EXPECT_FALSE(arbiter_.has_retracted());
  now_.at_rest = 1;
  EXPECT_FALSE(next());
  EXPECT_TRUE(arbiter_.has_retracted());
}

// The way in began at once at full speed; who stands in his friction would spring ahead.
TEST_F(RetractRequest, GetsFasterNoMoreThanATenthOfTheFastestRateEachSecond) {
  go_in();
  arbiter_.retract(now_, 0);
  wait_for_rest();
  constexpr double dt_s = 0.02;
  const double max_rad = 0.1 * zhu2022::table().limits.theta_rate_rad_s * dt_s * dt_s;
  double before_rad = 0.0, fastest_rad = 0.0;
  for (int i = 0; i < 200; ++i) {
    const auto setpoint = next();
    if (!setpoint) break;
    const double step_rad = std::fabs(setpoint->joint_rad[0] - now_.theta_command_rad[0]);
    EXPECT_LE(step_rad, before_rad + 1.0001 * max_rad + 1e-12) << "interval " << i;
    before_rad = step_rad;
    fastest_rad = std::max(fastest_rad, step_rad);
    now_.theta_command_rad = setpoint->joint_rad;
  }
  EXPECT_TRUE(arbiter_.has_retracted());
  EXPECT_GT(fastest_rad, 10.0 * max_rad) << "it does get faster";
}

TEST_F(RetractRequest, EndsAndSaysWhyWhenTheArmDoesNotComeToRestOrIsNotEnabledAnyMoreOrIsHeld) {
  go_in();
  now_.at_rest = 0;
  arbiter_.retract(now_, 0);
  int intervals = 0;
  for (; arbiter_.is_busy() && intervals < 2000; ++intervals) next();
  EXPECT_EQ(intervals, 1001) << "20 s";
  EXPECT_TRUE(names(arbiter_.retract_state().reason, {"rest", "20 s"}));
  arbiter_.retract(now_, 0);
  arbiter_.hold();
  EXPECT_EQ(arbiter_.retract_state().reason, "held");
  arbiter_.retract(now_, 0);
  now_.state = OperatingState::kStopping;
  next();
  EXPECT_EQ(arbiter_.retract_state().phase, RetractPhase::kEnded);
  EXPECT_TRUE(names(arbiter_.retract_state().reason, {"enabled"}));
  EXPECT_FALSE(arbiter_.has_retracted());
  EXPECT_EQ(arbiter_.take_way_news().back().what, event::RetractEvent::kEnds);
}

// Brakes hold the drums, the arm swings a little, and is enabled beside its path.
TEST_F(RetractRequest, SurvivesAStopAndIsJoinedAgainByAMoveOfItsOwn) {
  go_in();
  const ThetaVector end = now_.theta_command_rad;
  now_.state = OperatingState::kDisabled;
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(next());
  now_.state = OperatingState::kEnabled;
  now_.theta_command_rad[1] += 0.004;
  next();
  const auto kept = arbiter_.take_way_news();
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(kept[0].what, event::RetractEvent::kKept);
  EXPECT_GT(kept[0].distance_m, 0.005);
  EXPECT_LT(kept[0].distance_m, kJoin_m);
  arbiter_.retract(now_, 0);
  wait_for_rest();
  double largest_step_rad = 0.0;
  bool was_on_the_path = false, has_joined = false;
  for (auto setpoint = next(); setpoint; setpoint = next()) {
    const bool joins = arbiter_.retract_state().phase == RetractPhase::kJoining;
    has_joined = has_joined || joins;
    if (joins) {
      largest_step_rad = std::max(largest_step_rad, std::fabs(setpoint->joint_rad[1] - now_.theta_command_rad[1]));
      EXPECT_NEAR(setpoint->joint_rad[0], end[0], 1e-9);
    }
    was_on_the_path = was_on_the_path || setpoint->joint_rad == end;
    now_.theta_command_rad = setpoint->joint_rad;
  }
  EXPECT_TRUE(has_joined);
  EXPECT_TRUE(was_on_the_path);
  EXPECT_LT(largest_step_rad, kJoinRate_rad_s * 0.02);
  EXPECT_EQ(now_.theta_command_rad[0], start_);
  EXPECT_TRUE(arbiter_.has_retracted());
}

TEST_F(RetractRequest, OfAnArmMovedBackByHandLeadsOnFromTheNearestPoint) {
  for (int i = 0; i < 8; ++i) go_in();
  now_.state = OperatingState::kDisabled;
  next();
  now_.state = OperatingState::kEnabled;
  now_.theta_command_rad[0] = start_ + 40 * kStep_rad;
  next();
  EXPECT_EQ(arbiter_.path_history().size(), 41u);
  arbiter_.retract(now_, 0);
  wait_for_rest();
  follow();
  EXPECT_EQ(now_.theta_command_rad[0], start_);
}

TEST_F(RetractRequest, OfAnArmEnabledFarFromItIsGivenUpAndNobodyIsToldThatItIsBack) {
  go_in();
  const std::uint64_t before = tick_;
  now_.state = OperatingState::kDisabled;
  next();
  now_.state = OperatingState::kEnabled;
  now_.theta_command_rad[0] += 0.1;
  next();
  EXPECT_EQ(arbiter_.take_way_news().back().what, event::RetractEvent::kLost);
  EXPECT_EQ(code_of([&] { arbiter_.retract(now_, 0); }), "refused");
  EXPECT_EQ(code_of([&] { arbiter_.retract(now_, before); }), "refused");
  EXPECT_FALSE(arbiter_.has_retracted());
  go_in();
  arbiter_.retract(now_, before);
  wait_for_rest();
  follow();
  EXPECT_EQ(arbiter_.retract_state().phase, RetractPhase::kEnded) << "it went as far as it could, and says so";
  EXPECT_TRUE(names(arbiter_.retract_state().reason, {"path", "farther"}));
}

TEST_F(RetractRequest, AsFarAsTheArmStandsAlreadyIsDoneAtOnce) {
  go_in();
  arbiter_.retract(now_, tick_ + 5);
  wait_for_rest();
  follow();
  EXPECT_TRUE(arbiter_.has_retracted());
  EXPECT_NEAR(now_.theta_command_rad[0], start_ + 19 * kStep_rad, 1e-12);
}

// A hold that was refused would otherwise be asked for again by the next tip goal, and never come to be.
TEST_F(RetractRequest, HoldsNothingAnyMore) {
  go_in();
  arbiter_.hold_theta(now_, 1u << 8, ThetaVector{});
  EXPECT_TRUE(next());
  arbiter_.refused();
  EXPECT_FALSE(arbiter_.is_asking());
  arbiter_.retract(now_, 0);
  wait_for_rest();
  follow();
  arbiter_.servo_tip(now_, now_.tip_command);
  EXPECT_EQ(next()->held_mask, 0u);
}

// Otherwise the operator grips again as soon as the way back ends, and steers in again.
TEST_F(RetractRequest, TakesTheDeviceAwayFromTheOperator) {
  use_hand();
  steered(0.2);
  go_in();
  EXPECT_EQ(code_of([&] { arbiter_.retract(now_, 0); }), "accepted");
  wait_for_rest();
  follow();
  EXPECT_FALSE(steered(0.3, false));
  EXPECT_FALSE(steered(0.3, true));
  EXPECT_FALSE(steered(0.4, true));
  EXPECT_EQ(arbiter_.device().in_use().kind, device::Kind::kNone);
}

// Else the tip would go on to where the hand has led it last.
TEST_F(Arbitration, ADeviceThatIsTakenAwayOrChangedWhileItLeadsHoldsTheArm) {
  for (const device::Kind kind : {device::Kind::kNone, device::Kind::kVrControllers}) {
    use_hand();
    steered(0.2);
    ASSERT_TRUE(steered(0.4));
    arbiter_.use_device(now_, DeviceUse{.kind = kind});
    EXPECT_FALSE(arbiter_.next_setpoint(tick_ += 5, now_));
    EXPECT_FALSE(arbiter_.is_asking());
  }
}

// Paths, with a check that says what it is told to.
class Paths : public Arbitration {
 protected:
  using Request = PathRequest<CableArm>;

  CableArbiter& with(const std::string& refusal, SearchResult taken = SearchResult::kInItsInterval) {
    checked_.emplace(table_, SpeedZone{}, taken, [this, refusal](const auto& points, std::optional<double> margin_m) {
      ++looks_;
      looked_at_ = points.size();
      margin_m_ = margin_m.value_or(-1.0);
      return refusal;
    });
    return *checked_;
  }
  Request path() const {
    Request request{{now_.theta_command_rad, now_.theta_command_rad}, 0.03, 0.005, "abc"};
    request.points_rad[1][0] += 0.01;
    return request;
  }
  static std::string text_of(const std::function<void()>& request) {
    try {
      request();
    } catch (const api::RequestError& error) {
      return error.code() + std::string(": ") + error.what();
    }
    return "accepted";
  }

  std::optional<CableArbiter> checked_;
  std::size_t looks_ = 0, looked_at_ = 0;
  double margin_m_ = 0.0;
};

TEST_F(Paths, APathGoesThroughItsPointsWithoutAStopAndSaysSo) {
  CableArbiter& arbiter = with("");
  const Request request = path();
  arbiter.move_path(now_, request);
  EXPECT_TRUE(arbiter.is_busy());
  EXPECT_EQ(text_of([&] { arbiter.move_path(now_, request); }).substr(0, 4), "busy");
  ThetaVector last = now_.theta_command_rad;
  double share = 0.0;
  while (arbiter.is_busy()) {
    const auto setpoint = arbiter.next_setpoint(tick_ += 5, now_);
    ASSERT_TRUE(setpoint);
    ASSERT_EQ(setpoint->kind, CommandKind::kJoint);
    EXPECT_GE(setpoint->joint_rad[0], last[0]);
    last = setpoint->joint_rad;
    if (!arbiter.path()) break;
    EXPECT_EQ(arbiter.path()->hash, "abc");
    EXPECT_GE(arbiter.path()->share, share);
    share = arbiter.path()->share;
  }
  EXPECT_EQ(last, request.points_rad[1]);
  EXPECT_EQ(looked_at_, 3u) << "from where the command stands";
  EXPECT_EQ(margin_m_, 0.005);
  const auto news = arbiter.take_path_news();
  ASSERT_EQ(news.size(), 2u);
  EXPECT_TRUE(names(news[0].text, {"abc", "begins"}));
  EXPECT_EQ(news[1].what, event::PathEvent::kArrives);
  EXPECT_TRUE(names(news[1].text, {"abc", "arrived"}));
  EXPECT_EQ(news[1].path.share, 1.0);
  EXPECT_GT(news[1].duration_s, 1.0);
  EXPECT_TRUE(arbiter.take_path_news().empty());
}

TEST_F(Paths, APathThatTheCheckRefusesDoesNotMoveTheArm) {
  CableArbiter& arbiter = with("link 9 is 1 mm from 'panel'");
  arbiter.move_path(now_, path());
  EXPECT_FALSE(arbiter.next_setpoint(tick_ += 5, now_));
  EXPECT_FALSE(arbiter.is_busy());
  const auto news = arbiter.take_path_news();
  ASSERT_EQ(news.size(), 1u);
  EXPECT_EQ(news[0].what, event::PathEvent::kRefused);
  EXPECT_TRUE(names(news[0].text, {"abc", "refused", "link 9", "1 mm", "panel"}));
}

TEST_F(Paths, AJointMoveWhoseWayTheCheckRefusesDoesNotMoveTheArm) {
  CableArbiter& arbiter = with("after 40 % link 9 is 1 mm from 'panel'");
  ThetaVector goal = now_.theta_command_rad;
  goal[0] += 0.01;
  arbiter.move_joints(now_, goal, 0.03);
  now_.at_rest = 0;
  EXPECT_FALSE(arbiter.next_setpoint(tick_ += 5, now_));
  EXPECT_EQ(looked_at_, 0u) << "it is looked at from where the arm has come to rest";
  now_.at_rest = 1;
  EXPECT_FALSE(arbiter.next_setpoint(tick_ += 5, now_));
  EXPECT_EQ(looked_at_, 2u);
  EXPECT_FALSE(arbiter.is_busy());
  const auto news = arbiter.take_path_news();
  ASSERT_EQ(news.size(), 1u);
  EXPECT_EQ(news[0].what, event::PathEvent::kRefused);
  EXPECT_TRUE(names(news[0].text, {"move_jp", "refused", "40 %", "link 9"}));
}

TEST_F(Paths, AJointMoveIsLookedAtOnceAndThenGoes) {
  CableArbiter& arbiter = with("");
  ThetaVector goal = now_.theta_command_rad;
  goal[0] += 0.01;
  arbiter.move_joints(now_, goal, 0.03);
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(arbiter.next_setpoint(tick_ += 5, now_));
  EXPECT_EQ(looks_, 1u);
  EXPECT_TRUE(arbiter.refused("", true)) << "and goes on from rest";
  for (int i = 0; i < 100; ++i) arbiter.next_setpoint(tick_ += 5, now_);
  EXPECT_TRUE(arbiter.next_setpoint(tick_ += 5, now_));
  EXPECT_EQ(looks_, 1u);
}

TEST_F(Paths, APathIsRefusedByTheNumberOfItsPoint) {
  CableArbiter& arbiter = with("");
  Request request = path();
  request.points_rad[1][2] = 1.0;
  EXPECT_TRUE(
      names(text_of([&] { arbiter.move_path(now_, request); }), {"out_of_range", "point 2", "theta 3", "57.2958 deg"}));
  request = path();
  request.points_rad[0][3] += 0.02;
  EXPECT_TRUE(
      names(text_of([&] { arbiter.move_path(now_, request); }), {"refused", "point 1", "theta 4", "1.14592 deg"}));
  now_.at_rest = 0;
  EXPECT_EQ(text_of([&] { arbiter.move_path(now_, path()); }).substr(0, 4), "busy");
  EXPECT_FALSE(arbiter.is_busy());
}

TEST_F(Paths, AHoldEndsAPathAlsoWhileItIsLookedAt) {
  CableArbiter& arbiter = with("", SearchResult::kWhenThere);
  arbiter.move_path(now_, path());
  arbiter.hold();
  EXPECT_FALSE(arbiter.is_busy());
  EXPECT_FALSE(arbiter.next_setpoint(tick_ += 5, now_));
  EXPECT_TRUE(names(arbiter.take_path_news().at(0).text, {"abc", "stops", "0 %"}));
  arbiter.move_path(now_, path());
  std::optional<Setpoint> setpoint;
  for (int i = 0; i < 5000 && !setpoint; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    setpoint = arbiter.next_setpoint(tick_ += 5, now_);
  }
  EXPECT_TRUE(setpoint);
}

TEST_F(Arbitration, DisablingForgetsHeldVariablesAndMotion) {
  ThetaVector held{};
  arbiter_.hold_theta(now_, 1u << 8, held);
  now_.state = OperatingState::kDisabled;
  EXPECT_FALSE(next());
  EXPECT_EQ(arbiter_.held_mask(), 0u);
}

}  // namespace
}  // namespace liana::arbiter
