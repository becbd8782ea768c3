#include "host/control/server/homing.hpp"

#include <gtest/gtest.h>

#include "host/drives/calibration/jig.hpp"
#include "tests/host/control/verification/sim_arm.hpp"
#include "tests/message.hpp"

namespace liana::server {

using namespace cable;
namespace {

// An arm in its fixture, as its drives report it.
class HomingOfAnArm : public ::testing::Test {
 protected:
  HomingOfAnArm() {
    robot_.table = verification::SimArm().table();
    robot_.named_poses_deg["jig"] = {12, -9, 7, -8, 12, -3, 12, -10, -12, -2};
    cable::CableVector tension_N{};
    tension_N.fill(30.0);
    const cable::CableVector out_m =
        calibration::beyond_zero_m(robot_.table, calibration::named_pose_rad(robot_, "jig"), tension_N);
    for (std::size_t i = 0; i < 15; ++i) {
      const cable::DriveParams& drive = robot_.table.drive[i];
      DriveFeedback& report = report_.inputs.drive[i];
      report.feedback_age_ticks = 0;
      report.position_counts =
          static_cast<std::int32_t>(drive.zero_counts + out_m[i] / (drive.direction * drive.metres_per_count));
      report.torque_permille = static_cast<std::int16_t>(30.0 / drive.newtons_per_permille);
    }
    report_.outputs.homed = 1;
  }
  // Drive 4 reports so much more.
  void turn(double change_m) {
    const cable::DriveParams& drive = robot_.table.drive[4];
    report_.inputs.drive[4].position_counts +=
        static_cast<std::int32_t>(change_m / (drive.direction * drive.metres_per_count));
  }

  config::RobotConfig robot_;
  realtime::ArmTickStatus<cable::CableArm> report_;
  cable::EstimatorState estimator_;
};

// req:C2
TEST_F(HomingOfAnArm, NeedsEveryDriveToHaveBeenHeard) {
  Homing homing(robot_, "");
  report_.inputs.drive[7].feedback_age_ticks = 0xFFFF;
  homing.look(report_, estimator_);
  EXPECT_EQ(homing.not_homed().reason, NotHomedReason::kDriveNotHeard);
  EXPECT_FALSE(homing.not_homed().is_homed());
  report_.inputs.drive[7].feedback_age_ticks = 0;
  homing.look(report_, estimator_);
  EXPECT_TRUE(homing.not_homed().is_homed());
}

TEST_F(HomingOfAnArm, NamesTheCablesThatContradictEachOtherTheWorstFirst) {
  Homing homing(robot_, "");
  report_.outputs.homed = 0;
  estimator_.residual_m[1] = 0.004;
  estimator_.residual_m[9] = -0.012;
  estimator_.residual_m[6] = 0.001;
  homing.look(report_, estimator_);
  EXPECT_EQ(homing.not_homed().reason, NotHomedReason::kLengthsContradict);
  EXPECT_TRUE(names(homing.not_homed().text,
                    {"cables 10 to 12", "segment 4", "12.0 mm", "cables 1 to 3", "segment 1", "4.0 mm", "1.5 mm"}));
  EXPECT_LT(homing.not_homed().text.find("segment 4"), homing.not_homed().text.find("segment 1"))
      << homing.not_homed().text;
}

// An encoder that counts its turns only with power: before and after, and also from the file that outlives lianad.
TEST_F(HomingOfAnArm, ADriveThatStandsWholeTurnsFromWhereItWasLeftIsNamed) {
  robot_.counts_per_turn = 65536;
  const double turn_m = 65536.0 * robot_.table.drive[4].metres_per_count;
  for (const bool from_file : {false, true}) {
    for (const auto& [turns, said] :
         {std::pair{1.0, "one turn"}, std::pair{-1.0, "one turn"}, std::pair{2.0, "2 turns"}}) {
      Homing homing(robot_, "");
      report_.outputs.homed = 1;
      if (from_file) {
        const cable::ThetaVector left_rad = calibration::named_pose_rad(robot_, "jig");
        homing.remember(left_rad);
      } else {
        homing.look(report_, estimator_);
        ASSERT_TRUE(homing.not_homed().is_homed());
      }
      turn(turns * turn_m);
      report_.outputs.homed = 0;
      estimator_.residual_m[4] = turns * turn_m / 3.0;
      homing.look(report_, estimator_);
      EXPECT_TRUE(names(homing.not_homed().text, {"drive 5 (node 5, segment 2)", said})) << homing.not_homed().text;
      EXPECT_EQ(homing.not_homed().text.find("drive 4"), std::string::npos) << homing.not_homed().text;
      turn(-turns * turn_m);
    }
  }
  Homing part(robot_, "");
  report_.outputs.homed = 1;
  part.look(report_, estimator_);
  turn(0.5 * turn_m);
  report_.outputs.homed = 0;
  part.look(report_, estimator_);
  EXPECT_EQ(part.not_homed().text.find("turn"), std::string::npos) << "half a turn is no lost turn";
}

TEST_F(HomingOfAnArm, IsRefusedUntilThePoseFitsOnceThenTheArmMayLeaveIt) {
  Homing homing(robot_, "jig");
  turn(0.004);
  homing.look(report_, estimator_);
  EXPECT_EQ(homing.not_homed().reason, NotHomedReason::kOtherPose);
  EXPECT_TRUE(names(homing.not_homed().text, {"drive 5 (node 5, segment 2)", "4.0 mm"}));
  turn(-0.004);
  report_.outputs.homed = 0;
  homing.look(report_, estimator_);
  EXPECT_EQ(homing.not_homed().reason, NotHomedReason::kNotSettled);
  EXPECT_FALSE(homing.not_homed().is_homed());
  turn(0.004);
  report_.outputs.homed = 1;
  homing.look(report_, estimator_);
  EXPECT_FALSE(homing.not_homed().is_homed()) << "the pose fitted, but only while the angles had not settled";
  turn(-0.004);
  homing.look(report_, estimator_);
  EXPECT_TRUE(homing.not_homed().is_homed());
  turn(0.1);
  homing.look(report_, estimator_);
  EXPECT_TRUE(homing.not_homed().is_homed());
}

}  // namespace
}  // namespace liana::server
