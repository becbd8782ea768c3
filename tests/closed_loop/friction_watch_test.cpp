// What the core finds out about friction and contact while it moves the bench's arm.
#include <gtest/gtest.h>

#include <cmath>

#include "arm_under_control.hpp"
#include "firmware_like/cable/arm/friction_watch.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

struct Found {
  double after_10_s = 0.0, after_60_s = 0.0;  // error as a share of the truth
  double flagged_s = -1.0;                    // of motion; -1: never
  double planned_mu = 0.0;
  std::int32_t faults = 0;
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
    const cable::FrictionReport& friction = now.outputs().friction;
    moved_s += now.outputs().at_rest != 0 ? 0.0 : now.table().tick_s;
    if (moved_s < 10.0) out.after_10_s = friction.mu / truth - 1.0;
    if (moved_s < 60.0) out.after_60_s = friction.mu / truth - 1.0;
    if (friction.not_as_declared != 0 && out.flagged_s < 0.0) out.flagged_s = moved_s;
  };
  for (const auto& [from, to] : {std::pair{back, there}, {there, back}}) {
    arm.follow(
        40.0,
        [&](double share) {
          cable::Setpoint setpoint;
          setpoint.kind = CommandKind::kJoint;
          for (std::size_t i = 0; i < from.size(); ++i)
            setpoint.joint_rad[i] = from[i] + minimum_jerk(share) * (to[i] - from[i]);
          return setpoint;
        },
        look);
  }
  out.planned_mu = arm.outputs().friction.planned_mu;
  out.faults = arm.outputs().faults.count;
  return out;
}

TEST(FrictionWatch, FrictionIsFoundToAFifteenthAndATwentieth) {
  for (const std::uint64_t seed : {1, 2, 3}) {
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
  for (const std::uint64_t seed : {1, 2}) {
    const Found out = found({"worn", seed, true, "prepare"}, "nominal");
    measured("worn, told nominal: flagged after", out.flagged_s, "s");
    measured("worn, told nominal: error after 60 s of motion", 100.0 * out.after_60_s, "%");
    EXPECT_GE(out.flagged_s, 0.0) << seed;
    EXPECT_LE(out.flagged_s, 10.0) << seed;
    EXPECT_LE(std::fabs(out.after_10_s), 0.15) << seed;
    EXPECT_LE(std::fabs(out.after_60_s), 0.05) << seed;
    EXPECT_GT(out.planned_mu, 0.075) << seed;
    EXPECT_LE(out.planned_mu, cable::kFrictionPlanMost + 1e-12) << seed;
    EXPECT_EQ(out.faults, 0) << "nothing goes slack, and friction is no contact";
  }
}

TEST(ContactWatch, AFreeArmThatIsSwungAboutItsRootFeelsNothing) {
  ArmUnderControl arm({"nominal", 1, true, "prepare"});
  arm.boot();
  const cable::ThetaVector from = arm.outputs().theta_command_rad;
  for (const double turn_deg : {3.0, -3.0, 0.0}) {
    cable::ThetaVector goal = from;
    goal[0] += turn_deg * kDegree;
    goal[1] += turn_deg * kDegree;
    arm.move_joints(goal, 6.0);
    EXPECT_EQ(arm.outputs().faults.count, 0) << turn_deg;
  }
  arm.hold(5.0);
  EXPECT_EQ(arm.outputs().faults.count, 0) << "it swings on for a while";
}

TEST(ContactWatch, ABodyThatIsSlowlyPressedAgainstThePanelIsAFaultThatHolds) {
  ArmUnderControl arm({"nominal", 1, true, "segment5_in_slit"});
  arm.boot();
  const cable::ThetaVector from = arm.outputs().theta_command_rad;
  arm.plant().take_load();
  double contact_N = 0.0, touched_s = -1.0, found_s = -1.0, time_s = 0.0;
  arm.follow(
      60.0,
      [&](double share) {
        cable::Setpoint setpoint;
        setpoint.kind = CommandKind::kJoint;
        setpoint.joint_rad = from;
        setpoint.joint_rad[7] += 1.5 * kDegree * minimum_jerk(share);
        return setpoint;
      },
      [&](ArmUnderControl& now) {
        time_s += now.table().tick_s;
        const double force_N = now.plant().take_load().contact_N;
        if (force_N > 0.5 && touched_s < 0.0) touched_s = time_s;
        if (found_s < 0.0) contact_N = std::fmax(contact_N, force_N);
        if (now.outputs().faults.count > 0 && found_s < 0.0) found_s = time_s;
      });
  measured("seconds from the first half newton to the fault", found_s - touched_s, "s");
  measured("largest contact until then", contact_N, "N");
  ASSERT_GE(touched_s, 0.0) << "the panel was not touched at all";
  ASSERT_GE(found_s, touched_s);
  EXPECT_EQ(arm.outputs().faults.fault[0].number, FaultNumber::kBodyContact);
  EXPECT_GE(arm.outputs().faults.fault[0].index, 0);
  EXPECT_GT(arm.outputs().faults.fault[0].detail, 100) << "0.01 N m";
  EXPECT_LE(contact_N, 5.0);
}

}  // namespace
}  // namespace liana::closed_loop
