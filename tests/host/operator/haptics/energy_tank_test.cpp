// The tank: whatever is asked of it, the port gives no more than what it took and what the tank held.
#include "host/operator/haptics/energy_tank.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/base/random/random.hpp"

namespace liana::haptics {
namespace {

TEST(EnergyTank, PassesAForceThatTakesEnergy) {
  EnergyTank tank({});
  Vec3 at{};
  for (int i = 0; i < 1000; ++i) {
    EXPECT_EQ(tank.pass({0.0, -5.0, 0.0}, at)[1], -5.0);
    at[1] += 1e-4;  // 0.1 m/s against the force
  }
  EXPECT_NEAR(tank.store_J(), 0.1 + 999 * 5e-4, 1e-9);
}

TEST(EnergyTank, KeepsNoMoreThanItsMost) {
  EnergyTank tank({});
  Vec3 at{};
  for (int i = 0; i < 5000; ++i) {
    tank.pass({0.0, -10.0, 0.0}, at);
    at[1] += 1e-4;
  }
  EXPECT_EQ(tank.store_J(), 1.0);
}

TEST(EnergyTank, LetsAForceThatGivesEnergyDieAwayWithoutAJump) {
  EnergyTank tank({});
  Vec3 at{};
  double last_N = 5.0, largest_N = 0.0, given_J = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double force_N = tank.pass({0.0, 5.0, 0.0}, at)[1];
    at[1] += 2e-4;  // 0.2 m/s with the force
    given_J += 2e-4 * force_N;
    largest_N = std::max(largest_N, last_N - force_N);
    last_N = force_N;
  }
  EXPECT_LT(given_J, 0.1);
  EXPECT_GT(given_J, 0.09);
  EXPECT_LT(last_N, 1e-3);
  EXPECT_LT(largest_N, 0.5);
}

TEST(EnergyTank, GivesAForceBackSlowly) {
  TankParams table;
  table.start_J = 0.0;
  EnergyTank tank(table);
  Vec3 at{};
  EXPECT_EQ(tank.pass({0.0, 5.0, 0.0}, at)[1], 0.0);
  double last_N = 0.0;
  for (int i = 0; i < 200; ++i) {
    at[1] -= 1e-3;  // brings in much
    const double force_N = tank.pass({0.0, 5.0, 0.0}, at)[1];
    EXPECT_LE(force_N - last_N, 0.05 + 1e-12);
    last_N = force_N;
  }
  EXPECT_EQ(last_N, 5.0);
}

// Motions up to the acceleration it is told, forces that know nothing of them, and the worst there is: forces that
// always go with the motion.
// req:C14
TEST(EnergyTank, NeverGivesMoreThanItHeldWhateverForcesAndMotions) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    simulated::RandomStream random(seed, 1);
    const auto vector = [&](double most) {
      return Vec3{random.uniform(-most, most), random.uniform(-most, most), random.uniform(-most, most)};
    };
    EnergyTank tank({});
    Vec3 at{}, speed{};
    double port_J = 0.0, least_J = 0.0;
    for (int i = 0; i < 5000; ++i) {
      const Vec3 wanted = seed % 2 == 0 ? vector(12.0) : scale(speed, 100.0);
      const Vec3 force = tank.pass(wanted, at);
      speed = add(scale(speed, 0.99), scale(vector(28.0), kTick_s));
      const Vec3 moved = scale(speed, kTick_s);
      at = add(at, moved);
      port_J -= dot(force, moved);
      least_J = std::min(least_J, port_J);
    }
    ASSERT_GE(least_J, -0.1) << "seed " << seed;
    if (seed % 2 == 0) continue;
    ASSERT_LT(least_J, -0.05) << "nothing was at stake: seed " << seed;
  }
}

}  // namespace
}  // namespace liana::haptics
