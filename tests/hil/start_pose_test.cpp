// Where the seeded arm begins.
#include <gtest/gtest.h>

#include <cmath>

#include "fixtures.hpp"
#include "hil/arm/true_parameters.hpp"

namespace liana::bench {
namespace {

TEST(StartPose, BesideAStopItIsOffOnItsInnerSideOnly) {
  RobotConfig robot = fixture_robot();
  const double limit_rad = robot.segments[0].theta_limit_rad, spread_rad = 0.5 * kRadPerDeg;
  robot.named_poses_rad["edge"] = std::vector<double>(robot.theta_count(), -limit_rad);
  robot.named_poses_rad["edge"][1] = limit_rad - 0.1 * kRadPerDeg;
  double farthest_rad = 0.0;
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Theta theta = start_pose(robot, "edge", spread_rad, seed);
    for (std::size_t i = 0; i < robot.theta_count(); ++i) EXPECT_LE(std::fabs(theta[i]), limit_rad) << i;
    farthest_rad = std::fmax(farthest_rad, limit_rad - std::fabs(theta[0]));
  }
  EXPECT_GT(farthest_rad, 0.8 * spread_rad) << "off by as much as anywhere";
}

}  // namespace
}  // namespace liana::bench
