// What the friction feed-forward is for: capstan friction bends the arm, and the core knows beforehand which way
// (physics study, section 3).
#include <gtest/gtest.h>

#include "arm_under_control.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

// Error at rest at panel edge, coming from prepare with mu 0.05 in the plant.
TruthError error_after_motion(const std::string& told) {
  ArmUnderControl arm({"nominal", 1, false, "prepare"}, told);
  arm.boot();
  arm.move_joints(named_pose_rad("panel_edge"), 40.0);
  arm.hold(10.0);
  return arm.error_against_command();
}

TEST(FrictionFeedForward, HalvesTheTipErrorThatFrictionLeavesAfterAMotion) {
  const TruthError without = error_after_motion("ideal");
  const TruthError with = error_after_motion("nominal");
  measured("mu 0.05, core told 0: tip error", without.tip_mm, "mm");
  measured("mu 0.05, core told 0: tip attitude error", without.tip_deg, "deg");
  measured("mu 0.05, core told 0.05: tip error", with.tip_mm, "mm");
  measured("mu 0.05, core told 0.05: tip attitude error", with.tip_deg, "deg");
  EXPECT_GT(without.tip_mm, 4.0) << "without an error to begin with this test shows nothing";
  EXPECT_LT(with.tip_mm, 0.5 * without.tip_mm);
  EXPECT_LT(with.joint_deg, 0.5 * without.joint_deg);
}

}  // namespace
}  // namespace liana::closed_loop
