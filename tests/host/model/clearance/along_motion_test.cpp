// Whole motions from single poses, against looking densely.
#include "host/model/clearance/along_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/model/clearance/arm_clearance.hpp"
#include "host/model/clearance/self_clearance.hpp"
#include "tests/host/model/clearance/draw.hpp"
#include "tests/rounds.hpp"

namespace liana::clearance {
namespace {

constexpr std::array<Vec3, 3> kUpright{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

// A motion between two axes, point by point on straight lines: nothing moves more than the farthest point does.
struct StraightMotion {
  std::vector<Vec3> from, to;
  std::vector<double> gone_m;

  StraightMotion(std::vector<Vec3> a, std::vector<Vec3> b, int poses) : from(std::move(a)), to(std::move(b)) {
    double farthest_m = 0.0;
    for (std::size_t i = 0; i < from.size(); ++i) farthest_m = std::max(farthest_m, norm(subtract(to[i], from[i])));
    for (int i = 0; i < poses; ++i) gone_m.push_back(farthest_m * (poses > 1 ? i / (poses - 1.0) : 0.0));
  }
  std::vector<Vec3> at(double share) const {
    std::vector<Vec3> points;
    for (std::size_t i = 0; i < from.size(); ++i)
      points.push_back(add(from[i], scale(subtract(to[i], from[i]), share)));
    return points;
  }
  std::vector<Vec3> pose(std::int32_t i) const {
    return at(gone_m.size() > 1 ? i / (static_cast<double>(gone_m.size()) - 1.0) : 0.0);
  }
};

std::vector<Vec3> straight_arm(const Vec3& base) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 40; ++i) points.push_back(add(base, {0.1 * i, 0.0, 0.0}));
  return points;
}

AlongMotion<ArmClearance> along(const StraightMotion& motion, const config::SceneConfig& scene, double enough_m,
                                double unseen_m = 0.0) {
  return min_along({motion.gone_m, 1.0, enough_m, unseen_m},
                   [&](std::int32_t i) { return arm_clearance(motion.pose(i), kRadius_m, scene); });
}

// req:C9
TEST(AlongMotion, IsNeverAboveWhatDenseLooksFindAndCloseBelowIt) {
  Draw draw(21);
  int free = 0;
  for (int i = 0; i < rounds(150); ++i) {
    const StraightMotion motion(draw.axis(40, 0.05), draw.axis(40, 0.05), 200);
    const config::SceneConfig scene = draw.scene(1, 2, 1.5, i % 3);
    const AlongMotion<ArmClearance> found = along(motion, scene, kNoObstacle_m);
    double dense_m = kNoObstacle_m;
    for (int k = 0; k <= 2000; ++k)
      dense_m = std::min(dense_m, arm_clearance(motion.at(k / 2000.0), kRadius_m, scene).distance_m());
    const double between_poses_m = motion.gone_m[1];
    EXPECT_LE(found.at_least_m, dense_m + 1e-12);
    EXPECT_GE(found.at_least_m, dense_m - 0.55 * between_poses_m);
    EXPECT_LE(found.at_least_m, found.nearest.distance_m());
    EXPECT_EQ(found.nearest.distance_m(), arm_clearance(motion.pose(found.pose), kRadius_m, scene).distance_m());
    free += dense_m > 0.0 ? 1 : 0;
  }
  EXPECT_GT(free, rounds(150) / 8);
}

// The arm jumps across a plate of 0.1 mm between two poses, both far from it.
// req:C9
TEST(AlongMotion, SeesAThinPlateBetweenTwoPoses) {
  config::SceneConfig scene;
  scene.boxes.push_back({"plate", {2.0, 0.0, 0.0}, {0.5, 0.00005, 0.5}, kUpright});
  for (const int poses : {2, 3, 4, 10, 100}) {
    const StraightMotion motion(straight_arm({0, -1.0, 0}), straight_arm({0, 1.1, 0}), poses);
    const AlongMotion<ArmClearance> found = along(motion, scene, 0.1);
    EXPECT_LE(found.at_least_m, 0.0) << poses << " poses";
  }
}

TEST(AlongMotion, OfAnArmThatPassesAPlateAtItsEdgeFindsPoseLinkAndBody) {
  config::SceneConfig scene;
  scene.spheres.push_back({"far", {0, 0, 9}, 0.5});
  scene.boxes.push_back(
      {"plate", {2.03, 0.3, 0.5}, {0.01, 0.01, 0.4}, kUpright});  // its lower end 0.1 m above the axis
  const StraightMotion motion(straight_arm({0, -1.0, 0}), straight_arm({0, 1.0, 0}), 401);
  const AlongMotion<ArmClearance> found = along(motion, scene, 0.5);
  EXPECT_NEAR(found.nearest.distance_m(), 0.07, 1e-12);
  EXPECT_NEAR(found.at_least_m, 0.07 - 0.0025, 1e-9);
  EXPECT_NEAR(-1.0 + 0.005 * found.pose, 0.3, 0.0101);
  EXPECT_EQ(found.nearest.link, 20);
  EXPECT_EQ(obstacle_name(scene, found.nearest.obstacle), "plate");
}

TEST(AlongMotion, LooksTwiceWhereTheArmStaysAwayByMoreThanItMoves) {
  config::SceneConfig scene;
  scene.spheres.push_back({"far", {0, 0, 5}, 0.5});
  const StraightMotion motion(straight_arm({0, 0, 0}), straight_arm({0, 0.5, 0}), 440);
  const AlongMotion<ArmClearance> found = along(motion, scene, 1.0);
  EXPECT_EQ(found.looks, 2);
  EXPECT_EQ(found.at_least_m, 1.0);
}

TEST(AlongMotion, LooksLessWhereMoreMayStayUnseen) {
  config::SceneConfig scene;
  scene.boxes.push_back({"plate", {2.0, 0.0, 0.54}, {5, 5, 0.5}, kUpright});  // 10 mm above the arm's surface
  const StraightMotion motion(straight_arm({0, 0, 0}), straight_arm({0.05, 0.02, 0}), 440);
  const AlongMotion<ArmClearance> sharp = along(motion, scene, 0.1), coarse = along(motion, scene, 0.1, 0.002);
  EXPECT_NEAR(sharp.at_least_m, 0.010, 1e-4);
  EXPECT_GE(coarse.at_least_m, 0.008);
  EXPECT_LE(coarse.at_least_m, 0.010);
  EXPECT_LE(coarse.looks, 33);
  EXPECT_EQ(sharp.looks, 440);
}

TEST(AlongMotion, OfTheArmItselfTakesBothLinksAsMoving) {
  Draw draw(22);
  for (int i = 0; i < rounds(100); ++i) {
    const StraightMotion motion(draw.axis(40, 0.05), draw.axis(40, 0.05), 100);
    const AlongMotion<SelfClearance> found =
        min_along({motion.gone_m, 2.0, kNoObstacle_m, 0.0},
                  [&](std::int32_t pose) { return self_clearance(motion.pose(pose), kRadius_m, 8); });
    for (int k = 0; k <= 1000; ++k)
      EXPECT_GE(self_clearance(motion.at(k / 1000.0), kRadius_m, 8).distance_m(), found.at_least_m - 1e-12);
  }
}

TEST(AlongMotion, OfOnePoseIsThatPoseAndOfNoneNothing) {
  config::SceneConfig scene;
  scene.spheres.push_back({"near", {0, 0, 0.6}, 0.5});
  const StraightMotion motion(straight_arm({0, 0, 0}), straight_arm({0, 0, 0}), 1);
  EXPECT_NEAR(along(motion, scene, 1.0).at_least_m, 0.07, 1e-12);
  EXPECT_EQ(along(motion, scene, 1.0).looks, 1);
  EXPECT_EQ(min_along({{}, 1.0, 1.0, 0.0}, [](std::int32_t) { return SelfClearance{}; }).pose, -1);
}

TEST(AlongMotion, OfWhatIsNoNumberIsNeverFree) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  config::SceneConfig scene;
  scene.spheres.push_back({"far", {0, 0, 5}, 0.5});
  for (const std::size_t where : {0u, 8u}) {
    std::vector<double> gone_m{0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
    const auto look = [&](std::int32_t i) {
      std::vector<Vec3> points = straight_arm({0, 0, 0});
      if (static_cast<std::size_t>(i) == where) points[7][2] = nan;
      return arm_clearance(points, kRadius_m, scene);
    };
    EXPECT_EQ(min_along({gone_m, 1.0, 1.0, 0.0}, look).at_least_m, -kNoObstacle_m);
    gone_m[where] = nan;
    const auto far = [&](std::int32_t) { return arm_clearance(straight_arm({0, 0, 0}), kRadius_m, scene); };
    EXPECT_EQ(min_along({gone_m, 1.0, 1.0, 0.0}, far).at_least_m, -kNoObstacle_m);
  }
}

// A pose that could not be decided counts as touching, and its neighbours do not make up for it.
TEST(AlongMotion, IsNotAboveAnyPoseHoweverFarItsNeighboursAre) {
  const std::vector<double> gone_m{0.0, 0.1, 0.2};
  const auto look = [](std::int32_t i) { return SelfClearance{i == 1 ? 0.0 : 0.15, 0, 9}; };
  EXPECT_NEAR(min_along({gone_m, 2.0, 1.0, 0.0}, look).at_least_m, -0.025, 1e-15);
  const std::vector<double> still_m{0.0, 0.0, 0.0};
  const auto first = [](std::int32_t i) { return SelfClearance{i == 0 ? 0.0 : 0.5, 0, 9}; };
  EXPECT_EQ(min_along({still_m, 2.0, 1.0, 0.0}, first).at_least_m, 0.0);
}

}  // namespace
}  // namespace liana::clearance
