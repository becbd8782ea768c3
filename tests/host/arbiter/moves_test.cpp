// Planned moves keep the limits they are planned for.
#include "host/arbiter/moves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana {

using namespace cable;
namespace {

const RobotTable kTable = zhu2022::table();

TEST(JointMove, JointRatesAndTipSpeedStayUnderTheirLimits) {
  const ThetaVector from = zhu2022::radians(zhu2022::kPrepare_deg), to = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const JointMove move(kTable, from, to, kTable.limits.theta_rate_rad_s);
  const double dt_s = 0.01;
  double fastest_tip = 0.0, fastest_joint = 0.0;
  for (double t = 0.0; t < move.duration_s(); t += dt_s) {
    const ThetaVector a = move.at(t), b = move.at(t + dt_s);
    for (std::size_t i = 0; i < zhu2022::kThetas; ++i)
      fastest_joint = std::max(fastest_joint, std::fabs(b[i] - a[i]) / dt_s);
    const Vec3 way = subtract(forward_kinematics(kTable, b).tip_in_base.position_m,
                              forward_kinematics(kTable, a).tip_in_base.position_m);
    fastest_tip = std::max(fastest_tip, norm(way) / dt_s);
  }
  EXPECT_LE(fastest_joint, kTable.limits.theta_rate_rad_s);
  EXPECT_LE(fastest_tip, kTable.limits.tip_speed_m_s);
  EXPECT_GT(std::max(fastest_tip / kTable.limits.tip_speed_m_s, fastest_joint / kTable.limits.theta_rate_rad_s), 0.5)
      << "and not idle";
  EXPECT_EQ(move.at(move.duration_s()), to);
  EXPECT_EQ(move.at(0.0), from);
}

TEST(JointMove, ASlowerRateTakesLonger) {
  ThetaVector from{}, to{};
  to[8] = 0.01;
  const double fast_s = JointMove(kTable, from, to, 0.03).duration_s(),
               slow_s = JointMove(kTable, from, to, 0.001).duration_s();
  EXPECT_GT(slow_s, 2.0 * fast_s);
}

TEST(JointMove, NoWayTakesNoTime) {
  const ThetaVector here = zhu2022::radians(zhu2022::kPrepare_deg);
  const JointMove move(kTable, here, here, 0.03);
  EXPECT_EQ(move.duration_s(), 0.0);
  EXPECT_EQ(move.at(0.0), here);
}

TEST(TipLine, IsStraightKeepsTheSpeedAndArrivesExactly) {
  const Pose from{{1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}}, to{{1.3, 0.4, 0.0}, quaternion_of({0.0, 0.0, 0.3})};
  const TipLine line(kTable, from, to, 0.05);
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

TEST(PathMemory, GivesPointsBackNewestFirstDownToATick) {
  PathMemory path;
  for (std::uint64_t tick = 10; tick <= 50; tick += 10) {
    ThetaVector theta{};
    theta[0] = static_cast<double>(tick);
    path.note(tick, theta);
  }
  EXPECT_EQ((*path.step_back(25))[0], 50.0);
  EXPECT_EQ((*path.step_back(25))[0], 40.0);
  EXPECT_EQ((*path.step_back(25))[0], 30.0);
  EXPECT_FALSE(path.step_back(25)) << "the point of tick 20 is too old";
  EXPECT_EQ((*path.step_back(0))[0], 20.0);
}

TEST(PathMemory, StandingStillAddsNothing) {
  PathMemory path;
  for (std::uint64_t tick = 0; tick < 100; ++tick) path.note(tick, ThetaVector{});
  EXPECT_TRUE(path.step_back(0));
  EXPECT_TRUE(path.empty());
}

}  // namespace
}  // namespace liana
