// The adapter alone: its forces against what can be written down, its energy, misalignment and jams, its sensors.
#include "hil/serial/adapter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "tests/serial/sliding_plate.hpp"

namespace liana::bench {
namespace {

TipState plate_at(const Vec3& position_m, const Vec3& turn_rad = {}, const Vec3& velocity_m_s = {}) {
  return {{position_m, from_rotation_vector(turn_rad)}, velocity_m_s, {}};
}

void expect_near(const Vec3& got, const Vec3& wanted, double tolerance) {
  EXPECT_NEAR(got.x, wanted.x, tolerance);
  EXPECT_NEAR(got.y, wanted.y, tolerance);
  EXPECT_NEAR(got.z, wanted.z, tolerance);
}

TEST(Adapter, PushedStraightItIsTheCaptureSpring) {
  const Adapter adapter;
  for (const double depth : {0.001, 0.010, 0.0199}) {
    const TipLoad load = adapter.push(plate_at({0, 0, depth}, {}, {0, 0, 0.003}));
    const double dry = 4.0 * 0.003 / std::hypot(0.003, 1e-4);
    expect_near(load.force_N, {0, 0, -(900.0 * depth + 100.0 * 0.003 + dry)}, 1e-9);
    expect_near(load.torque_Nm, {0, 0, 0}, 1e-9);
  }
  expect_near(adapter.push(plate_at({0, 0, -0.005}, {}, {0, 0, 0.003})).force_N, {0, 0, 0}, 1e-12);
  // 5 mm in, drawn out quicker than the spring can follow.
  expect_near(adapter.push(plate_at({0, 0, 0.005}, {}, {0, 0, -1.0})).force_N, {0, 0, 0}, 1e-12);
}

TEST(Adapter, TheStopHoldsWhatTheSpringDoesNot) {
  const Adapter adapter;
  expect_near(adapter.push(plate_at({0, 0, 0.0221})).force_N, {0, 0, -(900.0 * 0.0221 + 1e5 * 0.0001)}, 1e-9);
}

TEST(Adapter, AtFullDepthThreePinsHoldThePlateSideways) {
  const Adapter adapter;
  const double play = 0.0003;
  for (const double angle : {0.0, 0.7, 2.5}) {
    const Vec3 aside = 0.0005 * Vec3{std::cos(angle), std::sin(angle), 0.0};
    const TipLoad load = adapter.push(plate_at(aside + Vec3{0, 0, 0.021}));
    expect_near(load.force_N, (-3.0 * 2e4 * (0.0005 - play) / 0.0005) * aside + Vec3{0, 0, -900.0 * 0.021}, 1e-9);
  }
  expect_near(adapter.push(plate_at({0.0002, 0, 0.021})).force_N, {0, 0, -900.0 * 0.021}, 1e-9);
  // Turned about its axis, every pin goes sideways by a chord.
  const double turn = 0.004, chord = 2.0 * 0.25 * std::sin(0.5 * turn);
  EXPECT_NEAR(adapter.push(plate_at({0, 0, 0.021}, {0, 0, turn})).torque_Nm.z,
              -3.0 * 2e4 * (chord - play) * 0.25 * std::cos(0.5 * turn), 1e-6);
}

TEST(Adapter, TheFunnelPushesOutAndInwardsAlike) {
  const Adapter adapter;
  // 10 mm before the face the funnel is 13 mm wide; 1 mm of three pins is in its wall.
  const TipLoad load = adapter.push(plate_at({0.014, 0, -0.010}));
  expect_near(load.force_N, {-60.0, 0, -60.0}, 1e-9);
  expect_near(adapter.push(plate_at({0.0129, 0, -0.010})).force_N, {0, 0, 0}, 1e-12);
  expect_near(adapter.push(plate_at({0.040, 0, -0.028})).force_N, {0, 0, 0}, 1e-12);     // before its mouth
  expect_near(adapter.push(plate_at({0.040, 0, -0.026})).force_N, {0, 0, -60.0}, 1e-9);  // beside it, on the face
}

TEST(Adapter, SlidingPinsRubAgainstTheWay) {
  const Adapter adapter;
  const TipLoad still = adapter.push(plate_at({0.0013, 0, 0.021}));
  const TipLoad in = adapter.push(plate_at({0.0013, 0, 0.021}, {}, {0, 0, 0.01}));
  const double press = 3.0 * 2e4 * 0.001;
  EXPECT_NEAR(still.force_N.x, -press, 1e-9);
  EXPECT_NEAR(in.force_N.z - still.force_N.z, -(0.15 * press + 4.0 + 100.0 * 0.01), 0.01);
}

// Work of the adapter on a plate that is led around a closed way, from the mouth to the stop and back, skewed.
double work_around_J(const AdapterParams& figures, double seconds, double phase) {
  const Adapter adapter(figures);
  const int steps = 20000;
  const auto place = [&](double t) {
    const double a = 2.0 * 3.14159265358979323846 * t;
    return std::pair<Vec3, Vec3>{{0.006 * std::cos(a + phase), 0.004 * std::sin(2 * a), -0.004 + 0.027 * std::sin(a)},
                                 {0.005 * std::sin(a), 0.006 * std::cos(3 * a), 0.01 * std::sin(2 * a + phase)}};
  };
  double work = 0.0;
  for (int i = 0; i < steps; ++i) {
    const auto [from, turn_from] = place(static_cast<double>(i) / steps);
    const auto [to, turn_to] = place(static_cast<double>(i + 1) / steps);
    const Quat before = from_rotation_vector(turn_from), after = from_rotation_vector(turn_to);
    const Quat change = after * conjugate(before);
    const Vec3 turned = 2.0 * Vec3{change.x, change.y, change.z}, moved = to - from;
    const double dt = seconds / steps;
    TipState plate{{0.5 * (from + to), from_rotation_vector(0.5 * (turn_from + turn_to))},
                   (1.0 / dt) * moved,
                   (1.0 / dt) * turned};
    const TipLoad load = adapter.push(plate);
    work += dot(load.force_N, moved) + dot(load.torque_Nm, turned);
  }
  return work;
}

TEST(Adapter, GivesNoEnergyOnAnyClosedWay) {
  AdapterParams elastic;
  elastic.friction = elastic.damping_Ns_m = elastic.spring_friction_N = elastic.spring_damping_Ns_m = 0.0;
  for (const double phase : {0.0, 1.0, 2.0, 3.0, 4.0, 5.0}) {
    EXPECT_NEAR(work_around_J(elastic, 10.0, phase), 0.0, 1e-3) << phase;
    EXPECT_LT(work_around_J(AdapterParams(), 10.0, phase), -0.05) << phase;
    EXPECT_LT(work_around_J(AdapterParams(), 0.5, phase), work_around_J(AdapterParams(), 10.0, phase)) << phase;
  }
}

TEST(Adapter, APlatePushedWith30NIsCapturedFromAnyOffsetThatTheFunnelTakes) {
  for (const Vec3& aside : {Vec3{0, 0, 0}, Vec3{0.0014, -0.0010, 0}, Vec3{0.015, 0.010, 0}, Vec3{0, -0.020, 0}}) {
    Adapter adapter;
    SlidingPlate plate{500.0, 4000.0, aside + Vec3{0, 0, -0.027}};
    plate.run(adapter, {0, 0, 30.0}, 40.0);
    EXPECT_TRUE(adapter.captured()) << aside.x << ' ' << aside.y;
    EXPECT_TRUE(adapter.latched());
    EXPECT_LT(plate.hardest_N, 60.0);
    // The latch draws it no farther, and holds it against a pull.
    const double depth = plate.at_m.z;
    plate.run(adapter, {0, 0, -50.0}, 10.0);
    EXPECT_NEAR(plate.at_m.z, depth, 0.002);
  }
}

TEST(Adapter, OutsideTheFunnelItStandsOnTheFaceAndIsNeverCaptured) {
  Adapter adapter;
  SlidingPlate plate{500.0, 4000.0, {0.035, 0, -0.040}};
  plate.run(adapter, {0, 0, 30.0}, 30.0);
  EXPECT_NEAR(plate.at_m.z, -0.027, 0.001);
  EXPECT_FALSE(adapter.captured());
}

// The funnel's walls stand at 45 deg: friction of more than 1 holds a pin there, whatever pushes along the axis.
TEST(Adapter, PinsThatStickInTheFunnelJam) {
  AdapterParams rough;
  rough.friction = 1.3;
  Adapter adapter(rough);
  SlidingPlate plate{500.0, 4000.0, {0.015, 0, -0.020}};
  plate.run(adapter, {0, 0, 30.0}, 30.0);
  EXPECT_LT(plate.at_m.z, -0.005);
  EXPECT_FALSE(adapter.captured());
  EXPECT_NEAR(-adapter.push(plate.state()).force_N.z, 30.0, 0.5) << "what is pushed is held";
}

TEST(Adapter, WhatLiesInAHoleStopsThePlateThere) {
  Adapter adapter;
  adapter.defects(1).blocked_m = 0.012;
  SlidingPlate plate{500.0, 4000.0, {0, 0, -0.005}};
  plate.run(adapter, {0, 0, 30.0}, 30.0);
  EXPECT_NEAR(plate.at_m.z, 0.0122, 0.0002);
  EXPECT_FALSE(adapter.captured());
}

TEST(Adapter, ABrokenLatchHoldsNothingAndAReleasedOneForgets) {
  Adapter adapter;
  adapter.break_latch();
  SlidingPlate plate{500.0, 4000.0, {0, 0, 0.0}};
  plate.run(adapter, {0, 0, 30.0}, 20.0);
  EXPECT_TRUE(adapter.captured());
  EXPECT_FALSE(adapter.latched());
  plate.run(adapter, {0, 0, -50.0}, 10.0);
  EXPECT_LT(plate.at_m.z, -0.05);
  adapter.release();
  EXPECT_FALSE(adapter.captured());
}

TEST(CaptureLogic, WantsTwoSensorsAtFullDepthAndAllAlmostForFiftyMilliseconds) {
  struct Case {
    PinValues depth_m;
    bool captured;
    const char* why;
  };
  const Case cases[] = {{{0.0201, 0.0201, 0.0196}, true, "two full, one almost"},
                        {{0.0201, 0.0199, 0.0199}, false, "one full"},
                        {{0.0201, 0.0201, 0.0194}, false, "the third hangs back"},
                        {{0.0205, 0.0205, 0.0205}, true, "all full"},
                        {{0.0300, 0.0300, 0.0}, false, "two sensors lie"}};
  for (const Case& test : cases) {
    CaptureLogic logic;
    for (int i = 0; i < 199; ++i) EXPECT_FALSE(logic.step(0.00025, test.depth_m)) << test.why;
    EXPECT_EQ(logic.step(0.00025, test.depth_m), test.captured) << test.why;
  }
  CaptureLogic interrupted;
  for (int i = 0; i < 150; ++i) interrupted.step(0.00025, {0.021, 0.021, 0.021});
  interrupted.step(0.00025, {0.021, 0.019, 0.021});
  for (int i = 0; i < 199; ++i) EXPECT_FALSE(interrupted.step(0.00025, {0.021, 0.021, 0.021}));
  EXPECT_TRUE(interrupted.step(0.00025, {0.021, 0.021, 0.021}));
  EXPECT_TRUE(interrupted.step(0.00025, {0, 0, 0})) << "captured is captured";
}

TEST(Adapter, ASensorThatLiesLowKeepsItFromCapturing) {
  Adapter adapter;
  adapter.defects(2).reads_m = 0.010;
  SlidingPlate plate{500.0, 4000.0, {0, 0, 0.0}};
  plate.run(adapter, {0, 0, 30.0}, 20.0);
  EXPECT_GT(plate.at_m.z, 0.0205);
  EXPECT_FALSE(adapter.captured());
  EXPECT_EQ(adapter.depth_m()[2], 0.010);
}

}  // namespace
}  // namespace liana::bench
