// The simulated device and the simulated hand on it.
#include "host/operator/haptics/omega.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "tests/host/drives/bus/allocation_count.hpp"

namespace liana::haptics {
namespace {

HandParams calm_hand() {
  HandParams hand;
  hand.tremor_m = 0.0;
  return hand;
}

Intent at(const Vec3& position_m) { return {position_m, {}, true}; }

// req:A30
TEST(Omega, AHandThatWantsToStayIsPushedAsFarAsItsSpringLets) {
  HeldOmega omega({}, calm_hand(), {}, 1);
  for (int i = 0; i < 3000; ++i) omega.step({0.0, 6.0, 0.0}, at({}));
  EXPECT_NEAR(omega.truth().position_m[1], 6.0 / 300.0, 1e-6);
  EXPECT_NEAR(omega.sample().pose.position_m[1], 0.02, 2e-5);
}

TEST(Omega, MotorsGiveTwelveNewtonsWhateverIsAsked) {
  HeldOmega omega({}, calm_hand(), {}, 1);
  for (int i = 0; i < 3000; ++i) omega.step({0.0, 100.0, 0.0}, at({}));
  EXPECT_NEAR(omega.truth().position_m[1], 12.0 / 300.0, 1e-6);
  EXPECT_GT(*std::max_element(omega.torques_Nm().begin(), omega.torques_Nm().end()), 0.3);
}

TEST(Omega, ItsReadingIsWithinTheResolutionOfTheDataSheet) {
  HeldOmega omega({}, HandParams{}, {}, 2);
  double worst_m = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double t = 1e-3 * i;
    omega.step({}, at({0.05 * std::sin(t), 0.06 * std::cos(1.3 * t), 0.04 * std::sin(2.0 * t)}));
    worst_m = std::max(worst_m, norm(subtract(omega.sample().pose.position_m, omega.truth().position_m)));
  }
  EXPECT_LT(worst_m, 1e-5);
  EXPECT_GT(worst_m, 1e-6);
}

TEST(Omega, TheWristIsSensedInItsRangeAndNothingTurnsIt) {
  HeldOmega omega({}, calm_hand(), {}, 1);
  for (int i = 0; i < 300; ++i) omega.step({12.0, 0.0, 0.0}, {{}, {0.5, 0.0, 0.0}, false});
  EXPECT_NEAR(rotation_vector(omega.sample().pose.quaternion)[0], 0.5, 1e-9);
  for (int i = 0; i < 300; ++i) omega.step({}, {{}, {0.0, 3.0, 0.0}, true});
  EXPECT_NEAR(rotation_vector(omega.sample().pose.quaternion)[1], 70.0 * kDegree, 1e-9);
  EXPECT_TRUE(omega.sample().deadman);
}

TEST(Omega, ItsWorkspaceEndsAtStops) {
  for (const Vec3& far : {Vec3{0.3, 0.0, 0.0}, Vec3{-0.3, 0.0, 0.0}, Vec3{0.0, 0.2, 0.2}, Vec3{0.0, -0.3, 0.0}}) {
    HeldOmega omega({}, calm_hand(), {}, 1);
    for (int i = 0; i < 3000; ++i) omega.step({}, at(far));
    const Vec3& p = omega.truth().position_m;
    EXPECT_LT(std::fabs(p[0]), 0.055 + 0.004);
    EXPECT_LT(std::hypot(p[1], p[2]), 0.080 + 0.004);
    EXPECT_TRUE(omega.sample().valid);
  }
}

TEST(Omega, WhatThePortAbsorbedIsForceTimesWay) {
  HeldOmega omega({}, calm_hand(), {}, 1);
  double way_N_m = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 before = omega.truth().position_m, force{1.0, -2.0, 0.5 * std::sin(0.01 * i)};
    omega.step(force, at({}));
    way_N_m += dot(force, subtract(omega.truth().position_m, before));
  }
  EXPECT_NEAR(omega.absorbed_J(), -way_N_m, 1e-12);
  EXPECT_LT(omega.absorbed_J(), -0.001);
}

TEST(Hand, ActsAfterItsReactionTimeAndNotBefore) {
  HeldOmega omega({}, calm_hand(), {}, 1);
  omega.step({}, at({}));
  for (int i = 0; i < 150; ++i) omega.step({}, at({0.0, 0.01, 0.0}));
  EXPECT_EQ(omega.truth().position_m[1], 0.0);
  omega.step({}, at({0.0, 0.01, 0.0}));
  EXPECT_GT(omega.truth().position_m[1], 0.0);
}

// Power of a motion at a frequency.
double power(const std::vector<double>& motion_m, double frequency_hz) {
  std::complex<double> sum;
  for (std::size_t i = 0; i < motion_m.size(); ++i)
    sum += motion_m[i] * std::polar(1.0, -2.0 * kPi * frequency_hz * 1e-3 * static_cast<double>(i));
  return std::norm(sum);
}

TEST(Hand, TremblesBetweenEightAndTwelveHertzByATenthOfAMillimetre) {
  HeldOmega omega({}, HandParams{}, {}, 3);
  for (int i = 0; i < 2000; ++i) omega.step({}, at({}));
  std::vector<double> motion_m;
  double square = 0.0, inside = 0.0, all = 0.0;
  for (int i = 0; i < 10000; ++i) {
    omega.step({}, at({}));
    motion_m.push_back(omega.truth().position_m[2]);
    square += motion_m.back() * motion_m.back() / 10000.0;
  }
  for (double f = 0.5; f < 30.0; f += 0.1) {
    const double here = power(motion_m, f);
    all += here;
    if (f > 7.8 && f < 12.2) inside += here;
  }
  EXPECT_GT(inside, 0.98 * all);
  EXPECT_GT(std::sqrt(square), 0.00005);
  EXPECT_LT(std::sqrt(square), 0.0003);
}

TEST(Omega, TheSameSeedGivesTheSameHandAndNothingComesFromTheHeap) {
  HeldOmega one({}, HandParams{}, {}, 5), two({}, HandParams{}, {}, 5);
  test::AllocationCount::clear();
  test::AllocationCount::start();
  bool same = true;
  for (int i = 0; i < 2000; ++i) {
    one.step({0.1, 0.2, 0.3}, at({0.01, 0.0, 0.0}));
    two.step({0.1, 0.2, 0.3}, at({0.01, 0.0, 0.0}));
    same = same && one.sample().pose.position_m == two.sample().pose.position_m;
  }
  test::AllocationCount::stop();
  EXPECT_TRUE(same);
  EXPECT_EQ(test::AllocationCount::value(), 0);
}

}  // namespace
}  // namespace liana::haptics
