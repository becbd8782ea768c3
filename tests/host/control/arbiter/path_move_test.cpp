// A path keeps to its points, its limits and its one time law.
#include "host/control/arbiter/path_move.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "firmware_like/math/trig.hpp"
#include "host/control/arbiter/cable_traits.hpp"
#include "host/control/arbiter/serial_traits.hpp"
#include "host/model/config/config.hpp"
#include "tests/firmware_like/micro_arm.hpp"
#include "tests/firmware_like/zhu2022.hpp"

namespace liana::arbiter {
namespace {

// Points that wander by a few degrees from one another, with corners of every size.
template <class Arm>
std::vector<Joints<Arm>> wandering(const typename Arm::Table& table, const Joints<Arm>& start, std::size_t count) {
  std::mt19937 random(7);
  std::vector<Joints<Arm>> points{start};
  for (std::size_t k = 1; k < count; ++k) {
    Joints<Arm> point = points.back();
    for (std::size_t i = 0; i < ArmTraits<Arm>::joint_count(table); ++i)
      point[i] += (static_cast<double>(random() % 2001) - 1000.0) * 1e-3 * 1.5 * kDegree;
    points.push_back(point);
  }
  return points;
}

template <class Arm>
struct Motion {
  std::vector<Joints<Arm>> joint_rad;  // at the start, and after every command interval
  double share_of_rate = 0.0, share_of_accel = 0.0, share_of_tip_speed = 0.0;
};

template <class Arm>
Motion<Arm> motion_along(const typename Arm::Table& table, const std::vector<Joints<Arm>>& points,
                         const SpeedZone& zone, double rate_rad_s) {
  using Kind = ArmTraits<Arm>;
  const BlendedPath<Arm> path(table, points);
  Motion<Arm> out{{points.front(), points.front()}};
  for (const double along : path_timing<Arm>(table, zone, path, rate_rad_s)) out.joint_rad.push_back(path.at(along));
  out.joint_rad.push_back(out.joint_rad.back());
  const double dt_s = interval_s(table);
  for (std::size_t k = 1; k + 1 < out.joint_rad.size(); ++k) {
    const auto &before = out.joint_rad[k - 1], &here = out.joint_rad[k], &after = out.joint_rad[k + 1];
    for (std::size_t i = 0; i < Kind::joint_count(table); ++i) {
      out.share_of_rate =
          std::max(out.share_of_rate, std::fabs(after[i] - here[i]) / dt_s / Kind::rate_rad_s(table, i));
      const double accel = std::fabs(after[i] - 2.0 * here[i] + before[i]) / (dt_s * dt_s);
      out.share_of_accel = std::max(out.share_of_accel, accel / Kind::move_accel_rad_s2(table, i));
    }
    const Vec3 from = Kind::tip_at(table, here).position_m, to = Kind::tip_at(table, after).position_m;
    const double limit = zone.limit_at(to, Kind::tip_bounds(table).linear.speed);
    out.share_of_tip_speed = std::max(out.share_of_tip_speed, norm(subtract(to, from)) / dt_s / limit);
  }
  return out;
}

const cable::RobotParams kCable = cable::zhu2022::table();
const cable::ThetaVector kPrepare = cable::zhu2022::radians(cable::zhu2022::kPrepare_deg);

TEST(BlendedPath, EndsAtItsEndsAndStaysNearItsStraightPieces) {
  const auto points = wandering<cable::CableArm>(kCable, kPrepare, 20);
  const BlendedPath<cable::CableArm> path(kCable, points);
  EXPECT_EQ(path.at(0.0), points.front());
  EXPECT_EQ(path.at(path.length_rad()), points.back());
  double along_rad = 0.0, max_off_m = 0.0;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    double length_rad = 0.0;
    for (std::size_t i = 0; i < points[k].size(); ++i) length_rad += std::pow(points[k + 1][i] - points[k][i], 2.0);
    length_rad = std::sqrt(length_rad);
    for (int share = 0; share < 50; ++share) {
      const auto straight = between(points[k], points[k + 1], share / 50.0);
      const auto rounded = path.at(along_rad + length_rad * share / 50.0);
      max_off_m = std::max(max_off_m, ArmTraits<cable::CableArm>::apart_m(kCable, straight, rounded));
    }
    along_rad += length_rad;
  }
  EXPECT_NEAR(along_rad, path.length_rad(), 1e-9);
  EXPECT_LE(max_off_m, 1.02 * kPathOff_m);
  EXPECT_GT(max_off_m, 0.5 * kPathOff_m) << "it uses what it may";
}

TEST(BlendedPath, HasNoCorners) {
  const auto points = wandering<cable::CableArm>(kCable, kPrepare, 10);
  const BlendedPath<cable::CableArm> path(kCable, points);
  const double step_rad = 1e-6;
  cable::ThetaVector before = path.at(0.0), here = path.at(step_rad);
  for (double along_rad = 2.0 * step_rad; along_rad < path.length_rad(); along_rad += step_rad) {
    const auto after = path.at(along_rad);
    for (std::size_t i = 0; i < cable::zhu2022::kThetas; ++i)
      ASSERT_LT(std::fabs(after[i] - 2.0 * here[i] + before[i]), 0.01 * step_rad) << "at " << along_rad;
    before = here;
    here = after;
  }
}

TEST(PathTiming, KeepsEveryLimitOfACableArmAndUsesThem) {
  const auto points = wandering<cable::CableArm>(kCable, kPrepare, 20);
  const auto motion = motion_along<cable::CableArm>(kCable, points, {}, 1.0);
  EXPECT_LE(motion.share_of_rate, 1.0);
  EXPECT_LE(motion.share_of_accel, 1.0001);
  EXPECT_LE(motion.share_of_tip_speed, 1.0);
  EXPECT_GT(motion.share_of_accel, 0.9) << "and does not dawdle";
  EXPECT_EQ(motion.joint_rad.back(), points.back());
}

TEST(PathTiming, KeepsEveryLimitOfASerialArm) {
  const serial::RobotParams table = serial::micro::table();
  const auto points = wandering<serial::SerialArm>(table, serial::micro::radians(serial::micro::kBent_deg), 15);
  const auto motion = motion_along<serial::SerialArm>(table, points, {}, 1.0);
  EXPECT_LE(motion.share_of_rate, 1.0);
  EXPECT_LE(motion.share_of_accel, 1.0001);
  EXPECT_LE(motion.share_of_tip_speed, 1.0);
  EXPECT_EQ(motion.joint_rad.back(), points.back());
}

TEST(PathTiming, DoesNotStopAtPointsThatLieOnOneLine) {
  cable::ThetaVector to = kPrepare;
  to[0] += 6.0 * kDegree;
  to[5] -= 3.0 * kDegree;
  std::vector<cable::ThetaVector> points;
  for (int k = 0; k <= 20; ++k) points.push_back(between(kPrepare, to, k / 20.0));
  const auto many = motion_along<cable::CableArm>(kCable, points, {}, 1.0);
  const auto two = motion_along<cable::CableArm>(kCable, {kPrepare, to}, {}, 1.0);
  EXPECT_LT(static_cast<double>(many.joint_rad.size()), 1.02 * static_cast<double>(two.joint_rad.size()));
}

// req:A9
TEST(PathTiming, SlowsTheTipDownWhereTheSceneWantsIt) {
  config::SceneSlit everywhere;
  everywhere.u_axis = {1.0, 0.0, 0.0};
  everywhere.normal = {0.0, 0.0, 1.0};
  everywhere.mouth_u_m = 0.0;
  everywhere.end_u_m = 10.0;
  everywhere.half_gap_m = 10.0;
  const SpeedZone zone(everywhere, 0.01);
  cable::ThetaVector to = kPrepare;
  to[0] += 6.0 * kDegree;
  const auto slow = motion_along<cable::CableArm>(kCable, {kPrepare, to}, zone, 1.0);
  const auto fast = motion_along<cable::CableArm>(kCable, {kPrepare, to}, {}, 1.0);
  EXPECT_LE(slow.share_of_tip_speed, 1.0);
  EXPECT_GT(slow.joint_rad.size(), 2 * fast.joint_rad.size());
}

TEST(PathTiming, ALowerRateTakesLonger) {
  const auto points = wandering<cable::CableArm>(kCable, kPrepare, 5);
  EXPECT_GT(motion_along<cable::CableArm>(kCable, points, {}, 0.0005).joint_rad.size(),
            2 * motion_along<cable::CableArm>(kCable, points, {}, 1.0).joint_rad.size());
}

TEST(PathTiming, NoWayIsOverAtOnce) {
  const BlendedPath<cable::CableArm> path(kCable, {kPrepare, kPrepare});
  EXPECT_EQ(path_timing<cable::CableArm>(kCable, {}, path, 1.0).size(), 1u);
  EXPECT_EQ(path.at(0.0), kPrepare);
}

}  // namespace
}  // namespace liana::arbiter
