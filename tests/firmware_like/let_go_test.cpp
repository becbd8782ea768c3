// A cable that is missed: its segment is let go at once, judged, and taken back when it was there all the time.
#include "firmware_like/cable/arm/let_go.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "firmware_like/cable/arm/payout.hpp"
#include "firmware_like/cable/arm/sparing.hpp"
#include "tests/firmware_like/ideal_drives.hpp"
#include "tests/firmware_like/safety_bench.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::cable {
namespace {

using safety_bench::kTimeout_s;

constexpr std::size_t kCable = 7, kFirst = 6, kEnd = 9;  // of segment 3

// An enabled arm on ideal drives whose reading of one cable can be lost.
class LetGo : public testing::Test {
 protected:
  void SetUp() override {
    rig_.enable();
    start_ = rig_.out.drive;
    pose_rad_ = rig_.out.theta_command_rad;
  }
  // One tick; the drives go where they are told, one cable reads nothing.
  void tick(bool lost) {
    Inputs inputs = rig_.drives.inputs(rig_.now++);
    if (lost) inputs.drive[kCable].torque_permille = 0;
    rig_.out = rig_.controller.tick(inputs);
    rig_.drives.act(rig_.out);
  }
  // Cable that is let out since the start [m], by its target.
  double out_m(std::size_t cable) const {
    const DriveParams& drive = rig_.robot.drive[cable];
    return drive.direction * drive.metres_per_count *
           (rig_.out.drive[cable].target_counts - start_[cable].target_counts);
  }

  Rig rig_;
  DriveCommands start_{};
  ThetaVector pose_rad_{};
};

TEST_F(LetGo, OneLostSampleLetsTheWholeSegmentGoInTheSameTick) {
  tick(true);
  EXPECT_EQ(rig_.out.faults.count, 0) << "one wrong sample is no fault";
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
    if (c >= kFirst && c < kEnd) {
      EXPECT_GE(out_m(c), kSegmentRelease_m) << c;
    } else {
      EXPECT_LE(out_m(c), kLetGoStep_m - kSegmentRelease_m) << c;
    }
    EXPECT_LE(out_m(c), kLetGoStep_m) << c;
  }
}

TEST_F(LetGo, ASampleThatShowsTensionAgainTakesEverythingBack) {
  tick(true);
  for (int i = 0; i < 500; ++i) tick(false);
  EXPECT_EQ(rig_.out.faults.count, 0);
  EXPECT_EQ(rig_.out.state, OperatingState::kEnabled);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) EXPECT_NEAR(out_m(c), 0.0, 2e-5) << c;
}

TEST_F(LetGo, ASampleFarBelowNothingLetsNothingGo) {
  Inputs inputs = rig_.drives.inputs(rig_.now++);
  std::int16_t& torque_permille = inputs.drive[kCable].torque_permille;
  torque_permille = static_cast<std::int16_t>(-torque_permille);
  rig_.out = rig_.controller.tick(inputs);
  EXPECT_EQ(rig_.out.faults.count, 0);
  for (std::size_t c = kFirst; c < kEnd; ++c) EXPECT_LE(out_m(c), kLetGoStep_m - kSegmentRelease_m) << c;
}

TEST_F(LetGo, ThreeLostSamplesAreABreakThatStopsWithPowerThenBrakes) {
  for (int i = 0; i < kBreakDebounceTicks; ++i) tick(true);
  ASSERT_EQ(rig_.out.faults.count, 1);
  EXPECT_EQ(rig_.out.faults.fault[0].number, FaultNumber::kCableBreak);
  EXPECT_EQ(rig_.out.faults.fault[0].index, static_cast<std::int16_t>(kCable));
  EXPECT_EQ(rig_.out.state, OperatingState::kStopping);
  for (std::size_t c = 0; c < zhu2022::kCables; ++c) EXPECT_EQ(rig_.out.drive[c].controlword, kEnableOperation);
  std::uint32_t ticks = 0;
  for (; ticks < 1000 && rig_.out.state != OperatingState::kFault; ++ticks) tick(true);
  EXPECT_EQ(rig_.out.state, OperatingState::kFault);
  EXPECT_LE(ticks, 125 + kTimeout_s.rest + kTimeout_s.braking + 10)
      << "5 mm are wound back at 10 mm/s, where drives have no lag";
  EXPECT_EQ(rig_.out.faults.count, 1) << "the cables that were let go are not slack";
}

TEST_F(LetGo, ABrokenSegmentEndsTautAtThePlannedPose) {
  for (int i = 0; i < 300; ++i) tick(true);
  const CableLayout layout = cable_layout(rig_.robot);
  const CableGeometry geometry = cable_geometry(rig_.robot, layout, arm_trig(rig_.robot, pose_rad_));
  for (std::size_t c = kFirst; c < kEnd; ++c) {
    const double taut_m = geometry.length_m[c] + rig_.robot.lead_m;
    EXPECT_NEAR(rig_.out.payout_command_m[c], taut_m, 0.1e-3) << c;
    EXPECT_EQ(rig_.out.tension_plan_N[c], 0.0);
  }
}

TEST_F(LetGo, WhileReadingsAreInDoubtTwoSamplesAreNeeded) {
  Setpoint broken = rig_.joints(rig_.out.theta_command_rad);
  broken.joint_rad[0] = std::numeric_limits<double>::quiet_NaN();
  rig_.tick(Request::kNone, rig_.release(broken));
  ASSERT_EQ(rig_.out.faults.count, 1);
  tick(true);
  EXPECT_LE(out_m(kCable), 1e-4);
  tick(true);
  EXPECT_GE(out_m(kCable), kSegmentRelease_m);
}

TEST(PlanWithout, BalancesEveryOtherSegmentNearTheFloorWithoutTheLooseOne) {
  const RobotParams robot = zhu2022::table(0.0);
  const CableLayout layout = cable_layout(robot);
  zhu2022::Random random(3);
  for (std::int32_t i = 0; i < 200; ++i) {
    const ArmTrig trig = arm_trig(robot, random.theta(robot, 15.0));
    const CableGeometry geometry = cable_geometry(robot, layout, trig);
    const TensionRatio ratio = tension_ratio(robot, layout, trig, SlipState{});
    const std::int32_t loose = i % robot.segment_count;
    const TensionPlan plan = plan_without(robot, layout, geometry, ratio,
                                          {SegmentReleaseStage::kBroken, loose, 3 * loose, kLetGoSettleTicks}, {});
    for (std::size_t k = 0; k < 10; ++k) {
      double torque_Nm = 0.0;
      for (std::size_t c = 0; c < zhu2022::kCables; ++c) torque_Nm += geometry.jacobian_m_rad[c][k] * plan.motor_N[c];
      if (static_cast<std::int32_t>(k / 2) == loose) continue;
      ASSERT_LE(std::fabs(torque_Nm), 1e-9) << loose << " " << k;
    }
    for (std::size_t c = 0; c < zhu2022::kCables; ++c) {
      if (layout.segment[c] == loose) {
        ASSERT_EQ(plan.motor_N[c], 0.0);
      } else {
        ASSERT_GE(plan.motor_N[c], robot.tension.floor_motor_N) << c;
      }
    }
  }
}

TEST(Sparing, ASegmentWithASlippedCableIsPulledLessOneWithASlackCableMore) {
  const RobotParams robot = zhu2022::table(0.0);
  const CableLayout layout = cable_layout(robot);
  FaultList faults{};
  latch(faults, {FaultNumber::kCableSlip, 4, 0, 1});
  latch(faults, {FaultNumber::kCableSlack, 13, 0, 1});
  latch(faults, {FaultNumber::kTensionScatters, 0, 0, 1});
  SegmentVector lift_N{};
  spare_cables(robot, layout, faults, lift_N);
  EXPECT_NEAR(lift_N[1], -kSparingRate_N_s * robot.tick_s, 1e-12) << "not at once";
  for (int i = 0; i < 1000; ++i) spare_cables(robot, layout, faults, lift_N);
  EXPECT_NEAR(lift_N[1], -kSparing_N, 1e-9);
  EXPECT_NEAR(lift_N[4], kSparing_N, 1e-9);
  EXPECT_EQ(lift_N[0], 0.0) << "a reading that scatters says nothing of the tension";
}

TEST(Sparing, LessLiftLowersThePlanOfItsSegmentAndKeepsTheFloor) {
  const RobotParams robot = zhu2022::table(0.0);
  const CableLayout layout = cable_layout(robot);
  const ArmTrig trig = arm_trig(robot, zhu2022::radians(zhu2022::kPrepare_deg));
  const CableGeometry geometry = cable_geometry(robot, layout, trig);
  const TensionRatio ratio = tension_ratio(robot, layout, trig, SlipState{});
  const TensionPlan planned = plan_tension(robot, geometry, ratio, SegmentVector{});
  const TensionPlan spared = plan_tension(robot, geometry, ratio, {0.0, 0.0, 0.0, 0.0, -kSparing_N});
  for (std::size_t c = 12; c < 15; ++c) {
    EXPECT_LT(spared.motor_N[c], planned.motor_N[c] - 0.5 * kSparing_N);
    EXPECT_GE(spared.motor_N[c], robot.tension.floor_motor_N);
  }
}

}  // namespace
}  // namespace liana::cable
