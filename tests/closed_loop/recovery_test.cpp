// An arm that has lost a cable goes back along its path on those that are left, verified like any motion; nothing else
// moves it.
#include <gtest/gtest.h>

#include <algorithm>

#include "firmware_like/cable/arm/let_go.hpp"
#include "firmware_like/safety/faults.hpp"
#include "fixture.hpp"
#include "lead_out.hpp"
#include "verified_arm.hpp"

namespace liana::closed_loop {
namespace {

constexpr std::size_t kLost = 4;  // cable 5, of segment 2

cable::ThetaVector near_panel_edge(const cable::ThetaVector& from_rad) {
  cable::ThetaVector goal_rad = named_pose_rad("panel_edge");
  for (std::size_t k = 0; k < goal_rad.size(); ++k) goal_rad[k] = from_rad[k] + 0.15 * (goal_rad[k] - from_rad[k]);
  return goal_rad;
}

// At rest after a move, with a cable broken and the arm in FAULT.
struct Broken {
  VerifiedArm verified{PlantSetup{"nominal", 1, true, "prepare"}};
  cable::ThetaVector begin_rad{};

  Broken() {
    begin_rad = arm().outputs().theta_command_rad;
    run(0.1);
    verified.arbiter().move_joints(arm().outputs(), near_panel_edge(begin_rad), 0.02, {});
    for (int i = 0; i < 2000 && (i < 10 || arm().outputs().at_rest == 0); ++i) verified.interval();
    EXPECT_EQ(arm().outputs().faults.count, 0);
    arm().plant().loosen(kLost, 1.0);
    run(3.0);
  }
  ArmUnderControl& arm() { return verified.arm(); }
  void run(double seconds) {
    for (double t_s = 0.0; t_s < seconds; t_s += verified.interval_s()) verified.interval();
  }
  void enable() {
    arm().ask(Request::kEnable);
    for (int i = 0; i < 500 && arm().outputs().state != OperatingState::kEnabled; ++i) verified.interval();
    run(0.1);
  }
};

TEST(Recovery, ABrokenArmIsLedBackToTheBeginningOfItsPathThroughBothChecks) {
  Broken broken;
  ASSERT_EQ(broken.arm().outputs().state, OperatingState::kFault);
  ASSERT_EQ(broken.arm().outputs().faults.fault[0].number, FaultNumber::kCableBreak);
  broken.arm().ask(Request::kRecover);
  broken.run(0.5);
  ASSERT_EQ(broken.arm().outputs().state, OperatingState::kDisabled);
  broken.enable();
  ASSERT_EQ(broken.arm().outputs().state, OperatingState::kEnabled) << "without the cable that is lost";
  for (const std::size_t cable : {std::size_t{3}, kLost, std::size_t{5}})
    EXPECT_EQ(broken.arm().outputs().tension_plan_N[cable], 0.0) << cable;
  const double away_deg = largest_difference_deg(broken.arm().outputs().theta_command_rad, broken.begin_rad);
  ASSERT_GT(away_deg, 1.0);
  broken.arm().plant().take_load();
  broken.verified.arbiter().retract(broken.arm().outputs(), 0);
  for (int i = 0; i < 6000 && broken.verified.arbiter().is_going_back(); ++i) broken.verified.interval();
  EXPECT_EQ(broken.verified.arbiter().retract_state().phase, arbiter::RetractPhase::kDone)
      << broken.verified.arbiter().retract_state().reason;
  EXPECT_EQ(broken.arm().outputs().faults.count, 0);
  EXPECT_LT(largest_difference_deg(broken.arm().outputs().theta_command_rad, broken.begin_rad), 0.2);
  EXPECT_LT(broken.arm().plant().take_load().max_motor_N, broken.arm().table().tension.ceiling_free_N);
}

TEST(Recovery, NothingButTheWayBackMovesAnArmWithoutItsCable) {
  Broken broken;
  broken.arm().ask(Request::kRecover);
  broken.run(0.5);
  broken.enable();
  ASSERT_EQ(broken.arm().outputs().state, OperatingState::kEnabled);
  const cable::ThetaVector before_rad = broken.arm().outputs().theta_command_rad;
  broken.arm().move_joints(broken.begin_rad, 2.0);
  EXPECT_LT(largest_difference_deg(broken.arm().outputs().theta_command_rad, before_rad), 1e-3);
}

TEST(Recovery, AClearMakesTheCableCountAgainAndAnArmWithoutItIsNotEnabled) {
  Broken broken;
  broken.arm().ask(Request::kRecover);
  broken.run(0.5);
  broken.arm().ask(Request::kClear);
  broken.run(0.1);
  EXPECT_FALSE(cable::does_without(broken.arm().controller().arm().release()));
  broken.enable();
  EXPECT_EQ(broken.arm().outputs().state, OperatingState::kEnabling) << "10 s on, the cable is still missed";
  broken.arm().disable();
  broken.arm().ask(Request::kRecover);
  broken.run(0.1);
  EXPECT_TRUE(cable::does_without(broken.arm().controller().arm().release())) << "it was not whole";
}

TEST(Recovery, ASecondBreakOnTheWayStopsTheArm) {
  Broken broken;
  broken.arm().ask(Request::kRecover);
  broken.run(0.5);
  broken.enable();
  ASSERT_EQ(broken.arm().outputs().state, OperatingState::kEnabled);
  broken.arm().plant().loosen(10, 1.0);
  broken.run(3.0);
  EXPECT_EQ(broken.arm().outputs().state, OperatingState::kFault);
}

TEST(Recovery, WeightIsHeldByTheCablesThatAreLeftWhereTheyCanHoldIt) {
  ArmUnderControl arm({"nominal", 3, true, "park", CLOSED_LOOP_DATA "/lab_1g.json", kLying_m_s2},
                      lab_table(kLying_m_s2));
  arm.boot();
  arm.plant().loosen(0, 1.0);
  arm.wait(3.0);
  ASSERT_EQ(arm.outputs().faults.fault[0].number, FaultNumber::kCableBreak);
  arm.ask(Request::kRecover);
  arm.wait(0.5);
  const Vec3 before_m = arm.plant().tip_in_base().position_m;
  arm.ask(Request::kEnable);
  arm.wait(6.0);
  EXPECT_EQ(arm.outputs().state, OperatingState::kEnabled);
  EXPECT_EQ(arm.outputs().tension_plan_N[0], 0.0);
  EXPECT_GE(arm.outputs().tension_plan_N[1], arm.table().tension.floor_motor_N) << "its segment holds the weight";
  EXPECT_LT(distance_mm(before_m, arm.plant().tip_in_base().position_m), 20.0);
}

}  // namespace
}  // namespace liana::closed_loop
