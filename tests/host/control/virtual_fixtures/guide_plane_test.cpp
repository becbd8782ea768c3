// A goal brought into a plane: what is off the plane is taken away, and nothing else.
#include "host/control/virtual_fixtures/guide_plane.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"

namespace liana::virtual_fixtures {
namespace {

constexpr Vec3 kX{1.0, 0.0, 0.0}, kY{0.0, 1.0, 0.0};

class RandomPoses {
 public:
  explicit RandomPoses(std::uint64_t seed) : random_(seed) {}
  Vec3 within(double size) {
    std::uniform_real_distribution<double> one(-size, size);
    const double x = one(random_), y = one(random_), z = one(random_);
    return {x, y, z};
  }
  Pose pose() { return {within(3.0), normalize(quaternion_of(within(1.8)))}; }
  GuidePlane plane() {
    const Pose frame = pose();
    return {frame, normalize(multiply(quaternion_of(within(0.03)), frame.quaternion)), -kPi, kPi};
  }

 private:
  std::mt19937_64 random_;
};

double apart(const Pose& a, const Pose& b) {
  return norm(subtract(a.position_m, b.position_m)) +
         norm(rotation_vector(multiply(a.quaternion, conjugate(b.quaternion))));
}

TEST(InPlane, TakesAwayTheWayAlongTheNormalAndTheTurnOutOfThePlaneAlone) {
  RandomPoses random(1);
  for (int i = 0; i < 1000; ++i) {
    GuidePlane plane = random.plane();
    plane.side = i % 2 == 0 ? 1.0 : -1.0;
    const Pose goal = random.pose(), led = in_plane(plane, goal);
    const Vec3 normal = rotate(plane.frame_in_base.quaternion, kY), flat = rotate(plane.attitude, kY);
    EXPECT_NEAR(off_plane_m(plane, led.position_m), 0.0, 1e-12);
    const Vec3 moved = subtract(led.position_m, goal.position_m);
    EXPECT_NEAR(norm(cross(moved, normal)), 0.0, 1e-12) << "along the plane the goal stays";
    EXPECT_NEAR(dot(rotate(led.quaternion, kY), flat), plane.side, 1e-12);
    const Vec3 turn = rotation_vector(multiply(led.quaternion, conjugate(goal.quaternion)));
    EXPECT_NEAR(dot(turn, rotate(led.quaternion, kY)), 0.0, 1e-6) << "no yaw is added";
  }
}

TEST(InPlane, LeavesAGoalInThePlaneAsItIs) {
  RandomPoses random(2);
  for (int i = 0; i < 1000; ++i) {
    const GuidePlane plane = random.plane();
    const Pose led = in_plane(plane, random.pose());
    EXPECT_NEAR(apart(in_plane(plane, led), led), 0.0, 1e-9);
  }
}

TEST(InPlane, TurnsAYawOutOfRangeToItsNearerEnd) {
  struct Row {
    double yaw_deg, expected_deg;
  };
  GuidePlane plane;
  plane.yaw_low_rad = -20.0 * kDegree;
  plane.yaw_high_rad = 30.0 * kDegree;
  for (const Row& row :
       {Row{0, 0}, Row{30, 30}, Row{30.5, 30}, Row{-90, -20}, Row{100, 30}, Row{-150, -20}, Row{-179, 30}}) {
    const Pose led = in_plane(plane, {{}, quaternion_of({0.0, row.yaw_deg * kDegree, 0.0})});
    EXPECT_NEAR(yaw_rad(plane, led.quaternion) / kDegree, row.expected_deg, 1e-9) << row.yaw_deg;
  }
}

TEST(InPlane, CountsYawFromTheFramesXAboutItsNormal) {
  const GuidePlane level;
  EXPECT_NEAR(yaw_rad(level, quaternion_of({0.0, 0.3, 0.0})), 0.3, 1e-12);
  EXPECT_NEAR(yaw_rad(level, quaternion_of(scale(kX, 0.2))), 0.0, 1e-12) << "roll is no yaw";
}

}  // namespace
}  // namespace liana::virtual_fixtures
