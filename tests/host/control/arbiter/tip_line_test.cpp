// Straight lines of the tip keep the limits they are planned for.
#include "host/control/arbiter/tip_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "host/control/arbiter/cable_traits.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

TEST(TipLine, IsStraightKeepsTheSpeedAndArrivesExactly) {
  const Pose from{{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, to{{1.3, 0.4, 0.0}, quaternion_of({0.0, 0.0, 0.3})};
  const TipLine line(ArmTraits<CableArm>::tip_bounds(zhu2022::table()), from, to, 0.05);
  double fastest = 0.0;
  for (double t = 0.0; t < line.duration_s(); t += 0.01) {
    const Vec3 p = line.at(t).position_m;
    EXPECT_NEAR(p[1] * 3.0, (p[0] - 1.0) * 4.0, 1e-12);
    fastest = std::max(fastest, norm(subtract(line.at(t + 0.01).position_m, p)) / 0.01);
  }
  EXPECT_LE(fastest, 0.05);
  EXPECT_EQ(line.at(line.duration_s()).position_m, to.position_m);
  EXPECT_EQ(line.at(1e9).quaternion, to.quaternion);
}

}  // namespace
}  // namespace liana::arbiter
