// Cables that break, slip, or are read wrong in the middle of a motion: which fault, how soon, and what the arm does.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "arm_under_control.hpp"
#include "firmware_like/cable/arm/cable_monitor.hpp"
#include "firmware_like/math/trig.hpp"
#include "firmware_like/safety/drive_link_monitor.hpp"
#include "firmware_like/safety/faults.hpp"
#include "fixture.hpp"

namespace liana::closed_loop {
namespace {

constexpr std::size_t kCable = 7;

// Under way from prepare to panel edge, at about the highest speed.
void get_under_way(ArmUnderControl& arm) {
  arm.boot();
  const cable::ThetaVector from = arm.outputs().theta_command_rad;
  const cable::ThetaVector to = named_pose_rad("panel_edge");
  arm.follow(12.0, [&](double share) {
    cable::Setpoint setpoint;
    setpoint.kind = CommandKind::kJoint;
    for (std::size_t i = 0; i < 10; ++i)
      setpoint.joint_rad[i] = from[i] + minimum_jerk(0.5 * share) * (to[i] - from[i]);
    return setpoint;
  });
}

// A cable whose fault begins under way, its arm steered on as if nothing were.
struct Course {
  Fault first{};
  int ticks = 0;            // from the fault's begin until it was latched
  double travel_deg = 0.0;  // largest of any true angle from the fault's begin on
  OperatingState state = OperatingState::kDisabled;
};

Course under_way(const std::function<void(Plant&)>& begin) {
  constexpr int kBegin = 3000, kEnd = 5500;  // ticks
  ArmUnderControl arm({"nominal", 1, true, "prepare"});
  arm.boot();
  const cable::ThetaVector from = arm.outputs().theta_command_rad;
  const cable::ThetaVector to = named_pose_rad("panel_edge");
  Course course;
  cable::ThetaVector before{};
  int tick = 0;
  arm.follow(
      22.0,
      [&](double share) {
        cable::Setpoint setpoint;
        setpoint.kind = CommandKind::kJoint;
        for (std::size_t i = 0; i < 10; ++i)
          setpoint.joint_rad[i] = from[i] + minimum_jerk(0.55 * share) * (to[i] - from[i]);
        return setpoint;
      },
      [&](ArmUnderControl& now) {
        if (++tick == kBegin) {
          EXPECT_EQ(now.outputs().faults.count, 0);
          before = now.plant().theta_rad();
          begin(now.plant());
        }
        if (tick <= kBegin || tick > kEnd) return;
        course.travel_deg = std::max(course.travel_deg, largest_difference_deg(now.plant().theta_rad(), before));
        if (course.first.number != FaultNumber::kNone || now.outputs().faults.count == 0) return;
        course.first = now.outputs().faults.fault[0];
        course.ticks = tick - kBegin;
      });
  course.state = arm.outputs().state;
  return course;
}

TEST(CableFault, ALostTensionReadingIsABreakWithinItsDebounceAndTheArmStops) {
  ArmUnderControl arm({"nominal", 1, true, "prepare"});
  get_under_way(arm);
  ASSERT_EQ(arm.outputs().faults.count, 0);
  ASSERT_EQ(arm.outputs().at_rest, 0);
  arm.plant().lose_reading(kCable);
  int ticks = 0;
  while (arm.outputs().faults.count == 0 && ticks < 1000) {
    arm.step();
    ++ticks;
  }
  ASSERT_GE(arm.outputs().faults.count, 1);
  measured("ticks from the lost reading to the fault", ticks, "");
  EXPECT_EQ(arm.outputs().faults.fault[0].number, FaultNumber::kCableBreak);
  EXPECT_EQ(arm.outputs().faults.fault[0].index, static_cast<std::int16_t>(kCable));
  EXPECT_GE(ticks, cable::kBreakDebounceTicks) << "one wrong sample must not stop the arm";
  EXPECT_LE(ticks, cable::kBreakDebounceTicks + 1);

  arm.wait(2.0);
  EXPECT_EQ(arm.outputs().state, OperatingState::kFault) << "brakes hold what is left of the arm";
  EXPECT_EQ(arm.outputs().stop_category, StopCategory::kStop);
  const cable::ThetaVector held = arm.plant().theta_rad();
  arm.hold(2.0);
  EXPECT_LT(largest_difference_deg(arm.plant().theta_rad(), held), 0.1) << "no telecommand moves an arm in fault";
}

TEST(CableFault, ACableThatBreaksIsFoundBeforeTheArmHasMoved) {
  const Course course = under_way([](Plant& plant) { plant.loosen(kCable, 1.0); });
  EXPECT_EQ(course.first.number, FaultNumber::kCableBreak);
  EXPECT_EQ(course.first.index, static_cast<std::int16_t>(kCable));
  EXPECT_LE(course.ticks, cable::kBreakDebounceTicks + 1);
  EXPECT_EQ(course.state, OperatingState::kFault);
  measured("break: travel", course.travel_deg, "deg");
}

TEST(CableFault, ABreakInTheLastSegmentLetsItGoBeforeTheOthersSwingIt) {
  const Course course = under_way([](Plant& plant) { plant.loosen(14, 1.0); });
  EXPECT_EQ(course.first.number, FaultNumber::kCableBreak);
  measured("break in segment 5: travel in 10 s", course.travel_deg, "deg");
  EXPECT_LT(course.travel_deg, 26.0) << "30 deg with drums that stand";
}

// How far the tip of lab_1g falls along gravity, from the moment a fault begins until its brakes hold it.
double fall_mm(const Vec3& mounted_m_s2, const std::function<void(Plant&, std::size_t)>& begin) {
  ArmUnderControl arm({"nominal", 3, true, "park", CLOSED_LOOP_DATA "/lab_1g.json", mounted_m_s2},
                      lab_table(mounted_m_s2));
  arm.boot();
  const Vec3 down = scale(mounted_m_s2, 1.0 / kEarth_m_s2);
  Vec3 from_m{};
  double most_mm = 0.0;
  int tick = 0;
  arm.move_joints(lab_pose_rad("look"), 6.0, [&](ArmUnderControl& now) {
    if (++tick == 750) {
      const cable::CableVector& tension_N = now.outputs().tension_measured_N;
      begin(now.plant(), static_cast<std::size_t>(std::ranges::max_element(tension_N) - tension_N.begin()));
      from_m = now.plant().tip_in_base().position_m;
    }
    if (tick >= 750)
      most_mm = std::max(most_mm, 1000.0 * dot(subtract(now.plant().tip_in_base().position_m, from_m), down));
  });
  EXPECT_EQ(arm.outputs().faults.fault[0].number, FaultNumber::kCableBreak);
  EXPECT_EQ(arm.outputs().state, OperatingState::kFault);
  EXPECT_EQ(arm.outputs().stop_category, StopCategory::kStop);
  return most_mm;
}

// req:A26
TEST(CableFault, AnArmWithWeightDoesNotFallWhenTheCableThatCarriesMostBreaksHoweverItIsMounted) {
  for (const Vec3& mounted_m_s2 : {kLying_m_s2, kHanging_m_s2, kUpsideDown_m_s2, kStanding_m_s2}) {
    const double mm = fall_mm(mounted_m_s2, [](Plant& plant, std::size_t cable) { plant.loosen(cable, 1.0); });
    measured("break with weight: fall", mm, "mm");
    EXPECT_LT(mm, 30.0) << "400 mm when its segment is let go";
  }
}

TEST(CableFault, AnArmWithWeightIsNotLetGoForAReadingThatIsLost) {
  EXPECT_LT(fall_mm(kLying_m_s2, [](Plant& plant, std::size_t cable) { plant.lose_reading(cable); }), 12.0)
      << "its stop included; 23 mm when its segment is let go";
}

TEST(CableFault, AReadingThatIsLostForASampleIsNoFaultAndHardlyMovesTheArm) {
  ArmUnderControl arm({"nominal", 1, true, "prepare"});
  get_under_way(arm);
  arm.plant().lose_reading(kCable);
  arm.step();
  arm.plant().find_reading(kCable);
  const cable::ThetaVector before = arm.plant().theta_rad();
  double travel_deg = 0.0;
  for (int age = 0; age < 500; ++age) {
    arm.step();
    travel_deg = std::max(travel_deg, largest_difference_deg(arm.plant().theta_rad(), before));
  }
  EXPECT_EQ(arm.outputs().faults.count, 0);
  EXPECT_EQ(arm.outputs().state, OperatingState::kEnabled);
  measured("reading lost for a sample: travel, its stop included", travel_deg, "deg");
  EXPECT_LT(travel_deg, 1.5);
}

TEST(CableFault, ASlipOfTwoTenthsOfAMillimetreIsFoundAndTheArmHolds) {
  const Course course = under_way([](Plant& plant) { plant.loosen(kCable, 200e-6); });
  EXPECT_EQ(course.first.number, FaultNumber::kCableSlip);
  EXPECT_EQ(course.first.index, static_cast<std::int16_t>(kCable));
  EXPECT_LE(course.ticks, cable::kJumpConfirmTicks + 1);
  EXPECT_GE(course.first.detail, 100) << "micrometres";
  EXPECT_LE(course.first.detail, 400);
  EXPECT_EQ(course.state, OperatingState::kEnabled) << "a hold: the arm can be taken back along its path";
}

TEST(CableFault, AnEncoderThatJumpsByAFewTenthsOfAMillimetreIsFound) {
  const Course course = under_way([](Plant& plant) { plant.jump_encoder(kCable, 400e-6); });
  EXPECT_EQ(course.first.number, FaultNumber::kCableSlip);
  EXPECT_EQ(course.first.index, static_cast<std::int16_t>(kCable));
  EXPECT_LE(course.ticks, 10);
}

TEST(CableFault, ReadingsThatScatterAreFound) {
  const Course course = under_way([](Plant& plant) { plant.scatter(kCable, 30.0); });
  EXPECT_EQ(course.first.number, FaultNumber::kTensionScatters);
  EXPECT_EQ(course.first.index, static_cast<std::int16_t>(kCable));
  EXPECT_LE(course.ticks, 50);
}

// The damping believes the reading that is lost; its limit, 0.3 deg at the motors, is what bounds that.
TEST(CableFault, ALostTensionReadingOfAnArmAtRestHardlyMovesIt) {
  ArmUnderControl arm({"nominal", 1, true, "prepare"});
  arm.boot();
  arm.hold(5.0);
  const cable::ThetaVector before = arm.plant().theta_rad();
  const Vec3 tip_before_m = arm.plant().tip_in_base().position_m;
  arm.plant().lose_reading(kCable);
  double largest_deg = 0.0, largest_mm = 0.0;
  arm.hold(20.0, [&](ArmUnderControl& now) {
    largest_deg = std::max(largest_deg, largest_difference_deg(now.plant().theta_rad(), before));
    largest_mm = std::max(largest_mm, distance_mm(now.plant().tip_in_base().position_m, tip_before_m));
  });
  measured("lost reading at rest: largest joint motion in 20 s", largest_deg, "deg");
  measured("lost reading at rest: largest tip motion in 20 s", largest_mm, "mm");
  EXPECT_LT(largest_deg, cable::kDampingLimit_rad / kDegree);
  EXPECT_NE(arm.outputs().state, OperatingState::kEnabled) << "a fault that persists ends in brakes";
}

}  // namespace
}  // namespace liana::closed_loop
