// The light arm beside the full physics: the same arm at rest, and close to it while it moves as slowly as Liana moves
// it.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench_harness.hpp"
#include "hil/arm/arm_physics.hpp"
#include "hil/arm/kinematic_arm.hpp"

namespace liana::bench {
namespace {

double largest_deg(const Theta& a, const Theta& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < 10; ++i) largest = std::max(largest, std::fabs(a[i] - b[i]) / kRadPerDeg);
  return largest;
}

// The drums go on by `change_m` over the given time, then rest.
void wind(Arm& arm, const CableValues& change_m, double seconds, double rest_s) {
  const CableValues start = arm.payouts_m();
  const auto moving = static_cast<int>(seconds / kSlot_s), all = static_cast<int>((seconds + rest_s) / kSlot_s);
  for (int slot = 0; slot < all; ++slot) {
    CableValues payout = start;
    for (std::size_t c = 0; c < 15; ++c) payout[c] += change_m[c] * std::min(1.0, (slot + 1.0) / moving);
    arm.step(kSlot_s, payout);
  }
}

KinematicArm kinematic_arm(const RobotConfig& robot, const std::string& pose) {
  return KinematicArm(robot, table_parameters(robot, "ideal"), start_pose(robot, pose, 0.0, 1));
}

// Payouts that take the arm from one named pose towards another by the given share, every cable as tense as it was.
CableValues towards(const RobotConfig& robot, const std::string& from, const std::string& to, double share) {
  const Theta a = start_pose(robot, from, 0.0, 1), b = start_pose(robot, to, 0.0, 1);
  Theta goal{};
  for (std::size_t i = 0; i < 10; ++i) goal[i] = a[i] + share * (b[i] - a[i]);
  CablePaths at_start(robot), at_goal(robot);
  at_start.update(a);
  at_goal.update(goal);
  CableValues change{};
  for (std::size_t c = 0; c < 15; ++c) change[c] = at_goal.length_m(c) - at_start.length_m(c);
  return change;
}

TEST(KinematicArm, ItsTipIsWhereTheFullPhysicsHasIt) {
  const RobotConfig robot = fixture_robot();
  Random random(5, "light poses");
  Chain chain(robot, fixture_scene());
  for (int pose = 0; pose < 20; ++pose) {
    const Theta theta = random_theta(random, 19.0);
    chain.place(theta);
    const Pose light = tip_of(robot, theta), full = chain.tip();
    EXPECT_LT(norm(light.position_m - full.position_m), 1e-12);
    EXPECT_LT(norm(rotate(light.attitude, {0.0, 0.6, 0.8}) - rotate(full.attitude, {0.0, 0.6, 0.8})), 1e-12);
  }
}

TEST(KinematicArm, StaysWhereItStartsWithBrakesOn) {
  KinematicArm arm = kinematic_arm(fixture_robot(), "panel_edge");
  const Theta start = arm.theta_rad();
  wind(arm, CableValues{}, kSlot_s, 1.0);
  EXPECT_LT(largest_deg(arm.theta_rad(), start), 1e-9);
}

// Put where the light arm rests, with its drums, the full physics has nothing to do: 0.5 s without inertia's excuse of
// a slow swing.
TEST(KinematicArm, RestsWhereTheFullPhysicsStays) {
  SceneConfig open_space = fixture_scene();  // nothing to touch: the light arm knows no contact
  open_space.boxes.clear();
  open_space.spheres.clear();
  const RobotConfig robot = fixture_robot();
  for (const char* goal : {"panel_edge", "press_rod", "zero"}) {
    KinematicArm light = kinematic_arm(robot, "prepare");
    wind(light, towards(robot, "prepare", goal, 0.5), 3.0, 2.0);
    ASSERT_GT(largest_deg(light.theta_rad(), start_pose(robot, "prepare", 0.0, 1)), 2.0);
    ArmPhysics full(robot, open_space, table_parameters(robot, "ideal"), start_pose(robot, "prepare", 0.0, 1));
    full.set_state(light.theta_rad(), Theta{});
    for (int i = 0; i < 500; ++i) full.step(0.001, light.payouts_m());
    EXPECT_LT(largest_deg(light.theta_rad(), full.theta_rad()), 1e-6) << goal;
    for (std::size_t c = 0; c < 15; ++c)
      EXPECT_NEAR(light.motor_tension_N(c), full.motor_tension_N(c), 1e-4) << goal << " " << c;
  }
}

TEST(KinematicArm, TensionGrowsByStiffnessTimesElongationWhereDrumsPullAgainstEachOther) {
  const RobotConfig robot = fixture_robot();
  KinematicArm arm = kinematic_arm(robot, "zero");
  CableValues change{};
  for (std::size_t c = 0; c < 15; ++c) change[c] = -1e-4 * arm.payouts_m()[c];  // the straight arm cannot give way
  const double before_N = arm.motor_tension_N(0), grown_N = 1e-4 * robot.cable_EA_N;
  wind(arm, change, 1.0, 1.0);
  EXPECT_NEAR(arm.motor_tension_N(0) - before_N, grown_N, 0.01 * grown_N);
  EXPECT_LT(largest_deg(arm.theta_rad(), Theta{}), 0.01);
}

TEST(KinematicArm, ALooseCableIsSlackAndTheArmStaysNear) {
  KinematicArm arm = kinematic_arm(fixture_robot(), "prepare");
  const Theta start = arm.theta_rad();
  CableValues change{};
  change[3] = 0.02;
  wind(arm, change, kSlot_s, 2.0);
  EXPECT_EQ(arm.motor_tension_N(3), 0.0);
  EXPECT_EQ(arm.take_record().min_motor_tension_N, 0.0);
  EXPECT_LT(largest_deg(arm.theta_rad(), start), 5.0);
}

TEST(KinematicArm, IsRefusedWithFriction) {
  const RobotConfig robot = fixture_robot();
  EXPECT_THROW(KinematicArm(robot, table_parameters(robot, "nominal"), start_pose(robot, "zero", 0.0, 1)),
               std::runtime_error);
}

TEST(KinematicArm, TheSummarySaysWhichArmRan) {
  for (const char* arm : {"full", "light"}) {
    BenchOptions options = options_of(1);
    options.arm = arm;
    options.physics = "ideal";
    options.summary_path = temporary("arm.json");
    Bench bench(options);
    ScriptedBus bus(100, 0);
    bench.run(bus);
    EXPECT_EQ(nlohmann::json::parse(content(options.summary_path)).at("arm"), arm);
  }
  BenchOptions options = options_of(1);
  options.arm = "heavy";
  EXPECT_THROW(Bench{options}, std::runtime_error);
}

}  // namespace
}  // namespace liana::bench
