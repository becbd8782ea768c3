// What the core feels of something that touches the body of the bench's arm, and what it does not take for it.
#include <gtest/gtest.h>

#include <cmath>

#include "arm_under_control.hpp"
#include "firmware_like/math/trig.hpp"
#include "fixture.hpp"
#include "free_ways.hpp"
#include "slit_path.hpp"

namespace liana::closed_loop {
namespace {

bool felt(const ArmUnderControl& arm) { return arm.outputs().contact.on_body != 0; }

// req:A55
TEST(ContactWatch, AFreeArmFeelsNothingHoweverItIsMoved) {
  for (std::size_t i = 0; i < free_ways().size(); ++i) {
    const FreeWay& way = free_ways()[i];
    const bool is_worn = i % 2 == 0;  // and undeclared
    ArmUnderControl arm({is_worn ? "worn" : "nominal", 2 + i, true, "prepare"}, "nominal");
    arm.boot();
    double felt_s = 0.0;
    way.go(arm, i, [&](ArmUnderControl& now) { felt_s += felt(now) ? now.table().tick_s : 0.0; });
    EXPECT_EQ(felt_s, 0.0) << way.name;
    for (std::int32_t k = 0; k < arm.outputs().faults.count; ++k) {
      const FaultNumber number = arm.outputs().faults.fault[static_cast<std::size_t>(k)].number;
      EXPECT_FALSE(number == FaultNumber::kBodyContact || number == FaultNumber::kFrictionNotAsDeclared) << way.name;
    }
  }
}

// req:A55
TEST(ContactWatch, ABodyThatIsPressedAgainstThePanelIsAFaultThatHoldsWithSegmentAndSize) {
  ArmUnderControl arm({"nominal", 1, true, "press_rod"});
  arm.boot();
  cable::ThetaVector into_the_panel = arm.outputs().theta_command_rad;
  into_the_panel[2] -= kDegree;
  arm.plant().take_load();
  double contact_N = 0.0, touched_s = -1.0, found_s = -1.0, time_s = 0.0;
  arm.move_joints(into_the_panel, 60.0, [&](ArmUnderControl& now) {
    time_s += now.table().tick_s;
    const double force_N = now.plant().take_load().contact_N;
    if (force_N > 0.5 && touched_s < 0.0) touched_s = time_s;
    if (found_s < 0.0) contact_N = std::fmax(contact_N, force_N);
    if (now.outputs().faults.count > 0 && found_s < 0.0) found_s = time_s;
  });
  measured("panel: seconds from the first half newton to the fault", found_s - touched_s, "s");
  measured("panel: largest contact until then", contact_N, "N");
  ASSERT_GE(touched_s, 0.0) << "the panel was not touched at all";
  ASSERT_GE(found_s, touched_s);
  const Fault& first = arm.outputs().faults.fault[0];
  EXPECT_EQ(first.number, FaultNumber::kBodyContact);
  EXPECT_TRUE(first.index == 6 || first.index == 9) << first.index << ": the middle of the arm is in the slit's mouth";
  EXPECT_GT(first.detail, 250) << "0.01 N m";
  EXPECT_LE(contact_N, 3.0);
  const double left_N = arm.plant().take_load().contact_N;
  EXPECT_TRUE(left_N < 0.1 || arm.outputs().state == OperatingState::kFault)
      << left_N << " N: a hold whose cause stays becomes a stop";
}

// A weight on the tip of lab_1g, lying: faults of the arm, and how far its tension is from what is planned [N].
struct Carried {
  std::int32_t faults = 0;
  double off_N = 0.0;
};

Carried carry(std::uint64_t seed, double weighs_kg, double told_kg) {
  ArmUnderControl arm({"nominal", seed, true, "park", CLOSED_LOOP_DATA "/lab_1g.json", kLying_m_s2},
                      lab_table(kLying_m_s2));
  arm.boot();
  arm.carry({told_kg, {}});
  arm.hold(0.5);
  double share = 0.0;
  arm.hold(3.0, [&](ArmUnderControl& now) {
    share = std::fmin(1.0, share + now.table().tick_s);
    now.plant().push(15, {0.0, 0.0, -share * kEarth_m_s2 * weighs_kg});
  });
  arm.move_joints(lab_pose_rad("look"), 9.0);
  arm.move_joints(lab_pose_rad("park"), 9.0);
  arm.hold(1.0);
  Carried out{arm.outputs().faults.count, 0.0};
  for (std::size_t c = 0; c < static_cast<std::size_t>(arm.table().cable_count()); ++c)
    out.off_N = std::fmax(out.off_N, std::fabs(arm.outputs().tension_measured_N[c] - arm.outputs().tension_plan_N[c]));
  return out;
}

// req:A55
TEST(ContactWatch, AWeightThatTheArmIsToldOfIsHeldAndIsNoContact) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Carried told = carry(seed, 0.5, 0.5);
    EXPECT_EQ(told.faults, 0) << "seed " << seed;
    measured("0.5 kg at the tip, told: largest tension beside the plan", told.off_N, "N");
    const Carried without = carry(seed, 0.0, 0.0);
    EXPECT_LT(told.off_N, without.off_N + 8.0) << "seed " << seed << ": friction in proportion to more tension";
    EXPECT_EQ(without.faults, 0) << "seed " << seed;
  }
  EXPECT_GT(carry(1, 0.5, 0.0).faults, 0) << "of what nobody has told it, it says so";
}

struct Felt {
  FaultNumber first = FaultNumber::kNone;
  double force_N = 0.0;
  std::int32_t segment = 0;  // named by 5008, 1-based
};

// Half a newton a second more across a segment's middle, while the arm moves gently, until a fault says so.
Felt pushed(std::uint64_t seed, std::size_t segment, const Vec3& across) {
  constexpr double kRise_N_s = 0.5, kBegin_s = 12.0, kMove_s = 60.0, kInterval_s = 0.02;
  ArmUnderControl arm({"nominal", seed, true, "prepare"});
  arm.boot();
  const cable::ThetaVector from = arm.outputs().theta_command_rad, to = named_pose_rad("panel_edge");
  double time_s = 0.0;
  Felt felt;
  const auto push = [&](ArmUnderControl& now) {
    time_s += now.table().tick_s;
    const double force_N = std::fmax(0.0, kRise_N_s * (time_s - kBegin_s));
    now.plant().push(8 * segment + 4, scale(across, force_N));
    if (now.outputs().faults.count == 0 || felt.first != FaultNumber::kNone) return;
    felt = {now.outputs().faults.fault[0].number, force_N, now.outputs().contact.segment};
  };
  while (felt.first == FaultNumber::kNone && time_s < kMove_s) {
    cable::Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    const double done = minimum_jerk((time_s + kInterval_s) / kMove_s);
    for (std::size_t i = 0; i < from.size(); ++i) setpoint.joint_rad[i] = from[i] + done * (to[i] - from[i]);
    arm.follow(
        kInterval_s, [&](double) { return setpoint; }, push);
  }
  return felt;
}

// req:A55
TEST(ContactWatch, APushThatGrowsSlowlyIsFeltOnEverySegment) {
  int named = 0;
  for (std::size_t segment = 0; segment < 5; ++segment) {
    for (const Vec3& across : {Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}}) {
      const Felt felt = pushed(1, segment, across);
      measured("pushed along " + std::string(across[1] > 0.0 ? "y" : "z") + " in the middle of segment " +
                   std::to_string(segment + 1) + ": " + std::to_string(static_cast<int>(felt.first)) + ", segment " +
                   std::to_string(felt.segment) + ", from",
               felt.force_N, "N");
      EXPECT_NE(felt.first, FaultNumber::kNone) << segment;
      EXPECT_LT(felt.force_N, segment == 0 ? 20.0 : 12.0) << segment;
      EXPECT_LE(felt.segment, static_cast<std::int32_t>(segment + 1)) << "no segment beyond the push feels it";
      named += felt.first == FaultNumber::kBodyContact ? 1 : 0;
    }
  }
  EXPECT_GE(named, 6) << "of ten; where cables go slack first, that is said";
}

}  // namespace
}  // namespace liana::closed_loop
