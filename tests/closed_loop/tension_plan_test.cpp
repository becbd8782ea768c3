// What the tension plan is for: a command from geometry alone leaves even a frictionless arm beside its pose (physics
// study, section 1).
#include <gtest/gtest.h>

#include "arm_under_control.hpp"
#include "firmware_like/cable/arm/cables.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr double kLevel_N = 40.0;

PlantSetup exact_plant(const std::string& pose) { return {"ideal", 1, false, pose}; }

// Path and lead, shortened by the elongation of one constant tension: what a controller without a tension plan would
// send.
cable::CableVector geometric_payout_m(const cable::RobotParams& table, const cable::ThetaVector& theta_rad) {
  const cable::CableLayout layout = cable_layout(table);
  const cable::CableGeometry geometry = cable_geometry(table, layout, arm_trig(table, theta_rad));
  cable::CableVector payout{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
    payout[c] = (geometry.length_m[c] + table.lead_m) * (1.0 - kLevel_N / table.cable_EA_N);
  }
  return payout;
}

class TensionPlan : public ::testing::TestWithParam<const char*> {
 protected:
  std::string pose() const { return GetParam(); }
};

// Half of what the study's table gives at 40 N, for its cable is half as stiff: 7 mm at prepare, 10 mm at panel edge.
TEST_P(TensionPlan, WithoutItAFrictionlessArmStandsMillimetresBesideItsPose) {
  const cable::RobotParams& table = robot_table("ideal");
  Plant plant(exact_plant(pose()));
  plant.set_joint_damping(15.0);  // only to come to rest sooner
  const cable::CableVector payout = geometric_payout_m(table, named_pose_rad(pose()));
  for (int i = 0; i < 7500; ++i) plant.advance(table.tick_s, payout, true);
  const double miss_mm = distance_mm(plant.tip_in_base().position_m, tip_at(pose()).position_m);
  measured(pose() + ", geometric command: tip error", miss_mm, "mm");
  measured(pose() + ", geometric command: joint error",
           largest_difference_deg(plant.theta_rad(), named_pose_rad(pose())), "deg");
  EXPECT_GT(miss_mm, 3.0) << "with the plan it is under 1 mm";
  EXPECT_LT(miss_mm, 22.0);
}

TEST_P(TensionPlan, WithItTheArmStandsWithinAMillimetre) {
  ArmUnderControl arm(exact_plant(pose()));
  arm.boot();
  arm.move_joints(named_pose_rad(pose()), 1.0);
  arm.hold(15.0);
  const TruthError error = arm.error_against(named_pose_rad(pose()));
  measured(pose() + ", tension plan: tip error", error.tip_mm, "mm");
  measured(pose() + ", tension plan: joint error", error.joint_deg, "deg");
  EXPECT_LT(error.tip_mm, 1.0);
}

// The published poses at which nothing touches the arm.
INSTANTIATE_TEST_SUITE_P(AtPose, TensionPlan, ::testing::Values("prepare", "panel_edge"));

// Every angle at its limit, friction twice what is declared: where it holds the arm the ramp cannot know.
TEST(Enabling, AnArmInAFullCornerKeepsItsCablesTautOnEveryRamp) {
  for (const std::uint64_t seed : {1U, 6U}) {
    ArmUnderControl arm({"worn", seed, true, "20,20,-20,-20,20,20,-20,-20,20,20"}, "nominal");
    for (int enabling = 0; enabling < 2; ++enabling) {
      arm.plant().take_load();
      arm.boot();
      arm.wait(0.5);
      arm.disable();
      EXPECT_EQ(arm.outputs().state, OperatingState::kDisabled);
      EXPECT_GE(arm.plant().take_load().min_motor_N, 10.0) << "seed " << seed << ", enabling " << enabling;
    }
  }
}

// The same after a whole motion in between, from prepare to panel edge.
TEST(TensionPlanInMotion, AFrictionlessArmArrivesWithinAMillimetre) {
  ArmUnderControl arm(exact_plant("prepare"));
  arm.boot();
  arm.move_joints(named_pose_rad("panel_edge"), 40.0);
  arm.hold(10.0);
  const TruthError error = arm.error_against(named_pose_rad("panel_edge"));
  measured("prepare to panel edge, ideal: tip error", error.tip_mm, "mm");
  EXPECT_LT(error.tip_mm, 1.0);
}

}  // namespace
}  // namespace liana::closed_loop
