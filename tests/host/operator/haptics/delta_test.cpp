// The delta's closed forms against each other and against differences.
#include "host/operator/haptics/delta.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "host/base/random/random.hpp"
#include "host/operator/haptics/omega.hpp"

namespace liana::haptics {
namespace {

const OmegaTable kOmega{};

// Anywhere in the published workspace, 160 mm across and 110 mm deep.
Vec3 place_in_workspace(simulated::RandomStream& random) {
  const double angle = random.uniform(-kPi, kPi), radius_m = kOmega.radius_m * std::sqrt(random.uniform(0.0, 1.0));
  return {kOmega.centre_m + random.uniform(-kOmega.depth_m, kOmega.depth_m), radius_m * std::cos(angle),
          radius_m * std::sin(angle)};
}

// req:A30
TEST(Delta, EveryPlaceOfTheWorkspaceIsReachedByAnglesThatLeadBackToIt) {
  simulated::RandomStream random(1, 1);
  for (int i = 0; i < 10000; ++i) {
    const Vec3 place = place_in_workspace(random);
    const auto angles = delta_angles(kOmega.delta, place);
    ASSERT_TRUE(angles);
    const auto back = delta_position(kOmega.delta, *angles);
    ASSERT_TRUE(back);
    ASSERT_LT(norm(subtract(*back, place)), 1e-12);
  }
}

TEST(Delta, LowerArmsHaveTheirLengthWhateverTheAngles) {
  const JointAngles angles{0.1, 0.4, -0.2};
  const auto position = delta_position(kOmega.delta, angles);
  ASSERT_TRUE(position);
  for (std::size_t leg = 0; leg < 3; ++leg) {
    const double turn = 2.0 * kPi * static_cast<double>(leg) / 3.0;
    const double out_m = kOmega.delta.base_m + kOmega.delta.upper_m * std::cos(angles[leg]);
    const Vec3 elbow{kOmega.delta.upper_m * std::sin(angles[leg]), out_m * std::cos(turn), out_m * std::sin(turn)};
    EXPECT_NEAR(norm(subtract(*position, elbow)), kOmega.delta.lower_m, 1e-12);
  }
}

TEST(Delta, JacobianIsWhatDifferencesOfPositionsSay) {
  simulated::RandomStream random(2, 1);
  constexpr double kStep_rad = 1e-6;
  for (int i = 0; i < 1000; ++i) {
    const auto angles = delta_angles(kOmega.delta, place_in_workspace(random));
    const auto jacobian = delta_jacobian(kOmega.delta, *angles);
    ASSERT_TRUE(jacobian);
    for (std::size_t joint = 0; joint < 3; ++joint) {
      JointAngles more = *angles, less = *angles;
      more[joint] += kStep_rad;
      less[joint] -= kStep_rad;
      const Vec3 rate =
          scale(subtract(*delta_position(kOmega.delta, more), *delta_position(kOmega.delta, less)), 0.5 / kStep_rad);
      ASSERT_LT(norm(subtract(rate, (*jacobian)[joint])), 1e-8);
    }
  }
}

TEST(Delta, TorquesTimesSpeedsAreForceTimesVelocity) {
  simulated::RandomStream random(3, 1);
  const auto number = [&] { return random.uniform(-1.0, 1.0); };
  for (int i = 0; i < 100; ++i) {
    const auto jacobian = delta_jacobian(kOmega.delta, *delta_angles(kOmega.delta, place_in_workspace(random)));
    const Vec3 force{number(), number(), number()}, speeds{number(), number(), number()};
    const auto torques = delta_torques(*jacobian, force);
    Vec3 velocity{};
    for (std::size_t joint = 0; joint < 3; ++joint) velocity = add(velocity, scale((*jacobian)[joint], speeds[joint]));
    ASSERT_NEAR(dot(torques, speeds), dot(force, velocity), 1e-12);
  }
}

TEST(Delta, OutOfReachThereIsNothing) {
  EXPECT_FALSE(delta_angles(kOmega.delta, {0.5, 0.0, 0.0}));
  EXPECT_FALSE(delta_angles(kOmega.delta, {0.1, 0.4, 0.0}));
  EXPECT_FALSE(delta_angles(kOmega.delta, {std::nan(""), 0.0, 0.0}));
  const DeltaTable short_arms{0.04, 0.14, 0.05};
  EXPECT_FALSE(delta_position(short_arms, {0.0, 0.0, 0.0}));
  EXPECT_FALSE(delta_jacobian(short_arms, {0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace liana::haptics
