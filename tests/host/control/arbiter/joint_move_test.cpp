// Joint moves keep the limits they are planned for.
#include "host/control/arbiter/joint_move.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/control/arbiter/cable_traits.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::arbiter {

using namespace cable;
namespace {

using Move = JointMove<CableArm>;

const RobotParams kTable = zhu2022::table();

TEST(JointMove, JointRatesAndTipSpeedStayUnderTheirLimits) {
  const ThetaVector from = zhu2022::radians(zhu2022::kPrepare_deg), to = zhu2022::radians(zhu2022::kPanelEdge_deg);
  const Move move(kTable, from, to, kTable.limits.theta_rate_rad_s);
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
  const double fast_s = Move(kTable, from, to, 0.03).duration_s(), slow_s = Move(kTable, from, to, 0.001).duration_s();
  EXPECT_GT(slow_s, 2.0 * fast_s);
}

cable::Outputs at_rest(const ThetaVector& theta_rad) {
  cable::Outputs now{};
  now.theta_command_rad = theta_rad;
  now.at_rest = 1;
  return now;
}

TEST(JointMove, AfterARefusalItGoesOnMoreSlowlyComesToItsSpeedAgainAndMayBeRefusedElsewhere) {
  ThetaVector stands{}, to{};
  to[8] = 0.3;
  Move move(kTable, stands, to, kTable.limits.theta_rate_rad_s);
  const auto intervals_for = [&](double way_rad) {
    const double begin_rad = stands[8];
    int intervals = 0;
    for (; stands[8] < begin_rad + way_rad && !move.is_over() && intervals < 20000; ++intervals) {
      const auto goal = move.next(at_rest(stands));
      if (const auto* asked = std::get_if<ThetaVector>(&goal)) stands = *asked;
    }
    return intervals;
  };
  const int at_first = intervals_for(0.01);
  for (int refusals = 0; refusals < 12; ++refusals) {
    ASSERT_TRUE(move.refused()) << "each at another place";
    const int after = intervals_for(0.01);
    EXPECT_GT(after, at_first);
    EXPECT_LT(after, 20000);
  }
  intervals_for(1.0);
  EXPECT_EQ(stands, to);
}

TEST(JointMove, NoWayTakesNoTime) {
  const ThetaVector here = zhu2022::radians(zhu2022::kPrepare_deg);
  const Move move(kTable, here, here, 0.03);
  EXPECT_EQ(move.duration_s(), 0.0);
  EXPECT_EQ(move.at(0.0), here);
}

}  // namespace
}  // namespace liana::arbiter
