// What the core finds out about friction and contact while it moves the bench's arm.
#include <gtest/gtest.h>

#include <cmath>

#include "arm_under_control.hpp"
#include "firmware_like/cable/arm/friction_estimator.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

struct Found {
  double after_10_s = 0.0, after_60_s = 0.0;  // error as a share of the truth
  double flagged_s = -1.0;                    // of motion; -1: never
  double planned_mu = 0.0;
  std::int32_t faults = 0;
  int first = 0;  // its number
};

// To the panel's edge and back to the start, 40 s each.
Found found(const PlantSetup& setup, const std::string& told) {
  ArmUnderControl arm(setup, told);
  arm.boot();
  const cable::ThetaVector there = named_pose_rad("panel_edge"), back = arm.outputs().theta_command_rad;
  const double truth = arm.plant().friction_mu();
  Found out;
  double moved_s = 0.0;
  const auto look = [&](ArmUnderControl& now) {
    const cable::FrictionStatus& friction = now.outputs().friction;
    moved_s += now.outputs().at_rest != 0 ? 0.0 : now.table().tick_s;
    if (moved_s < 10.0) out.after_10_s = friction.mu / truth - 1.0;
    if (moved_s < 60.0) out.after_60_s = friction.mu / truth - 1.0;
    if (friction.not_as_declared != 0 && out.flagged_s < 0.0) out.flagged_s = moved_s;
  };
  for (const cable::ThetaVector& to : {there, back}) arm.move_joints(to, 40.0, look);
  out.planned_mu = arm.outputs().friction.planned_mu;
  out.faults = arm.outputs().faults.count;
  out.first = static_cast<int>(arm.outputs().faults.fault[0].number);
  return out;
}

TEST(FrictionWatch, FrictionIsFoundToAFifteenthAndATwentieth) {
  for (const std::uint64_t seed : {1u, 2u}) {
    const Found out = found({"nominal", seed, true, "prepare"}, "nominal");
    measured("nominal, error after 10 s of motion", 100.0 * out.after_10_s, "%");
    measured("nominal, error after 60 s of motion", 100.0 * out.after_60_s, "%");
    EXPECT_LE(std::fabs(out.after_10_s), 0.15) << seed;
    EXPECT_LE(std::fabs(out.after_60_s), 0.05) << seed;
    EXPECT_LT(out.flagged_s, 0.0) << "the bench's spread of 20 % is no news";
    EXPECT_EQ(out.faults, 0);
  }
}

TEST(FrictionWatch, UndeclaredWearIsFlaggedWithinTenSecondsAndPlannedWith) {
  for (const std::uint64_t seed : {1u}) {
    const Found out = found({"worn", seed, true, "prepare"}, "nominal");
    measured("worn, told nominal: flagged after", out.flagged_s, "s");
    measured("worn, told nominal: error after 60 s of motion", 100.0 * out.after_60_s, "%");
    EXPECT_GE(out.flagged_s, 0.0) << seed;
    EXPECT_LE(out.flagged_s, 10.0) << seed;
    EXPECT_LE(std::fabs(out.after_10_s), 0.15) << seed;
    EXPECT_LE(std::fabs(out.after_60_s), 0.05) << seed;
    EXPECT_GT(out.planned_mu, 0.075) << seed;
    EXPECT_LE(out.planned_mu, cable::kFrictionPlanMost + 1e-12) << seed;
    EXPECT_EQ(out.faults, 0) << "nothing goes slack, and friction is no contact, but " << out.first;
  }
}

}  // namespace
}  // namespace liana::closed_loop
