// feeder, an arm with weight on a base that feeds: the real core on the bench's physics.
#include <gtest/gtest.h>

#include <algorithm>

#include "arm_under_control.hpp"
#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"
#include "host/model/config/theta_numbers.hpp"

namespace liana::closed_loop {
namespace {

PlantSetup feeder_setup(std::uint64_t seed) { return {"nominal", seed, true, "back", CLOSED_LOOP_DATA "/feeder.json"}; }

struct FeederArm : ArmUnderControl {
  explicit FeederArm(std::uint64_t seed) : ArmUnderControl(feeder_setup(seed), feeder_table()) { boot(); }

  double tip_off_mm() {
    const Pose told = cable::forward_kinematics(table(), outputs().theta_command_rad).tip_in_base;
    return distance_mm(told.position_m, plant().tip_in_base().position_m);
  }
};

// Forward, then rolled by 75 degrees with its segments bent: gravity has turned for it.
const std::vector<double> kForward_deg{0, 0, 0, 0, 0, 0, 0, 0, 0, 0};
const std::vector<double> kRolled_deg{20, 75, 8, -5, 6, 4, -7, 5, 4, 8};

TEST(Feeder, SlidesAndRollsWithItsWeightOnItAndNothingIsTakenForAFault) {
  double most_mm = 0.0, least_N = 1e9;
  for (const std::uint64_t seed : {361u, 362u, 363u}) {
    FeederArm arm(seed);
    for (const auto& goal_deg : {kForward_deg, kRolled_deg}) {
      arm.plant().take_load();
      arm.move_joints(config::theta_rad(goal_deg), 35.0);
      arm.hold(2.0);
      ASSERT_EQ(arm.outputs().faults.count, 0) << seed << ", fault " << int(arm.outputs().faults.fault[0].number);
      EXPECT_NEAR(arm.plant().theta_rad()[0], goal_deg[0] * kDegree, 1e-3);
      EXPECT_NEAR(arm.plant().theta_rad()[1], goal_deg[1] * kDegree, 2e-3);
      most_mm = std::max(most_mm, arm.tip_off_mm());
      least_N = std::min(least_N, arm.plant().take_load().min_motor_N);
    }
  }
  measured("fed and rolled: tip beside where it is told", most_mm, "mm");
  measured("fed and rolled: least tension at a motor", least_N, "N");
  EXPECT_LT(most_mm, 8.0) << "1 % of its length";
  EXPECT_GT(least_N, feeder_table().tension.floor_motor_N);
}

TEST(Feeder, HoldsWhereItStandsWhenACableBreaksOrItsSlidesDriveIsLost) {
  for (const bool slide : {false, true}) {
    FeederArm arm(364);
    Vec3 from_m{};
    double most_mm = 0.0;
    int tick = 0;
    arm.move_joints(config::theta_rad(kRolled_deg), 40.0, [&](ArmUnderControl& now) {
      if (++tick == 5000) {
        slide ? now.lose_drive(0) : now.plant().loosen(4, 1.0);
        from_m = now.plant().tip_in_base().position_m;
      }
      if (tick >= 5000) most_mm = std::max(most_mm, distance_mm(now.plant().tip_in_base().position_m, from_m));
    });
    EXPECT_EQ(arm.outputs().state, OperatingState::kFault) << slide;
    EXPECT_EQ(arm.outputs().faults.fault[0].index, slide ? 0 : 4);
    measured(slide ? "slide's drive lost: tip moves" : "cable of segment 2 breaks: tip moves", most_mm, "mm");
    EXPECT_LT(most_mm, 100.0);
  }
}

}  // namespace
}  // namespace liana::closed_loop
