// The bounded searches over a whole arm against measuring everything: the same bits.
#include "host/model/clearance/arm_clearance.hpp"

#include <cstring>
#include <limits>

#include "firmware_like/math/trig.hpp"
#include "host/model/clearance/self_clearance.hpp"
#include "tests/firmware_like/zhu2022.hpp"
#include "tests/host/model/clearance/draw.hpp"
#include "tests/host/model/config/tables.hpp"

namespace liana::clearance {

using namespace cable;
namespace {

ArmClearance every_pair(AxisPoints points, double radius_m, const config::SceneConfig& scene) {
  ArmClearance out;
  out.nearest.distance_m = kNoObstacle_m;
  for (std::int32_t obstacle = 0; obstacle < obstacle_count(scene); ++obstacle) {
    for (std::int32_t link = 0; link + 1 < static_cast<std::int32_t>(points.size()); ++link) {
      const Clearance here = clearance(link_capsule(points, link, radius_m), scene, obstacle);
      if (here.distance_m < out.nearest.distance_m) out = {here, link, obstacle};
    }
  }
  return out;
}

SelfClearance every_pair(AxisPoints points, double radius_m, std::int32_t min_apart) {
  SelfClearance out;
  const std::int32_t links = static_cast<std::int32_t>(points.size()) - 1;
  for (std::int32_t a = 0; a < links; ++a) {
    for (std::int32_t b = a + min_apart; b < links; ++b) {
      const double here_m = between_m(link_capsule(points, a, radius_m), link_capsule(points, b, radius_m));
      if (here_m < out.nearest_m) out = {here_m, a, b};
    }
  }
  return out;
}

void expect_same_bits(const ArmClearance& a, const ArmClearance& b) {
  EXPECT_EQ(a.link, b.link);
  EXPECT_EQ(a.obstacle, b.obstacle);
  EXPECT_EQ(std::memcmp(&a.nearest, &b.nearest, sizeof a.nearest), 0) << a.distance_m() << " " << b.distance_m();
}

TEST(ArmClearance, HasTheBitsOfMeasuringEveryLinkAgainstEveryObstacle) {
  Draw draw(11);
  int near = 0, overlapping = 0;
  for (int i = 0; i < 4000; ++i) {
    const int links = i % 7 == 0 ? 1 + i % 150 : 40;
    const std::vector<Vec3> points = draw.axis(links, draw.number(0.02, 0.15));
    const config::SceneConfig scene = draw.scene(i % 3, i % 5, draw.number(0.2, 3.0), i % 4);
    const ArmClearance found = arm_clearance(points, kRadius_m, scene);
    expect_same_bits(found, every_pair(points, kRadius_m, scene));
    near += found.distance_m() > 0.0 && found.distance_m() < 0.1 ? 1 : 0;
    overlapping += found.distance_m() < 0.0 ? 1 : 0;
  }
  EXPECT_GT(near, 200);
  EXPECT_GT(overlapping, 500);
}

TEST(ArmClearance, OfEqualDistancesIsTheFirstObstaclesFirstLink) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 20; ++i) points.push_back({0.1 * i, 0.0, 0.0});
  config::SceneConfig scene;
  const std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  for (const double side : {1.0, -1.0}) scene.boxes.push_back({"plate", {1.0, 0.5 * side, 0.0}, {5, 0.1, 5}, axes});
  const ArmClearance found = arm_clearance(points, kRadius_m, scene);
  EXPECT_EQ(found.obstacle, 0);
  EXPECT_EQ(found.link, 0);
  expect_same_bits(found, every_pair(points, kRadius_m, scene));
}

TEST(ArmClearance, NamesTheLinkAndTheObstacle) {
  const config::SceneConfig scene = config::parse_scene(config::good_table("scene", "panel_slit").dump(), "s");
  ThetaVector theta{};
  for (std::size_t i = 0; i < zhu2022::kThetas; ++i) theta[i] = zhu2022::kPressRod_deg[i] * kDegree;
  const ArmClearance found = arm_clearance(link_points(zhu2022::table(), theta).axis(), kRadius_m, scene);
  EXPECT_NEAR(found.nearest.distance_m, 0.0090, 2e-4);  // mission, A8: at the mouth's edge near joint centre 22
  EXPECT_TRUE(obstacle_name(scene, found.obstacle) == "panel" || obstacle_name(scene, found.obstacle) == "wall");
  EXPECT_NEAR(found.link, 22, 2);
}

TEST(ArmClearance, OfAnEmptySceneIsFarAndNamesNothing) {
  const LinkPoints points = link_points(zhu2022::table(), ThetaVector{});
  const ArmClearance found = arm_clearance(points.axis(), kRadius_m, config::SceneConfig{});
  EXPECT_EQ(found.link, -1);
  EXPECT_EQ(found.nearest.distance_m, kNoObstacle_m);
}

TEST(ArmClearance, OfAnArmThatIsNoNumberIsNeverFree) {
  Draw draw(12);
  const config::SceneConfig scene = draw.scene(1, 1, 3.0);
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinite, -infinite, 1e300}) {
    for (const std::size_t where : {0u, 17u, 40u}) {
      std::vector<Vec3> points = draw.axis(40, 0.1);
      points[where][1] = bad;
      EXPECT_EQ(arm_clearance(points, kRadius_m, scene).distance_m(), -kNoObstacle_m) << bad << " at " << where;
      EXPECT_EQ(self_clearance(points, kRadius_m, 5).distance_m(), -kNoObstacle_m) << bad << " at " << where;
    }
  }
}

TEST(LinkClearances, AreExactWhereTheyAreAskedForAndNeverTooLargeElsewhere) {
  Draw draw(13);
  std::vector<Clearance> links;
  int exact = 0, bounded = 0;
  for (int i = 0; i < 500; ++i) {
    const std::vector<Vec3> points = draw.axis(40, 0.05);
    const config::SceneConfig scene = draw.scene(1, 1, 0.5, 3);
    const double within_m = draw.number(0.0, 0.3);
    for (std::int32_t obstacle = 0; obstacle < 5; ++obstacle) {
      link_clearances(points, kRadius_m, scene, obstacle, within_m, links);
      for (std::int32_t link = 0; link < 40; ++link) {
        const Clearance& found = links[static_cast<std::size_t>(link)];
        const Clearance truth = clearance(link_capsule(points, link, kRadius_m), scene, obstacle);
        const bool near = truth.distance_m < within_m;
        EXPECT_TRUE(!near || std::memcmp(&found, &truth, sizeof found) == 0);
        EXPECT_LE(found.distance_m, truth.distance_m);
        EXPECT_EQ(found.distance_m < within_m, near);
        (near ? exact : bounded) += 1;
      }
    }
  }
  EXPECT_GT(exact, 2000);
  EXPECT_GT(bounded, 4000);
}

TEST(SelfClearance, HasTheBitsOfMeasuringEveryPair) {
  Draw draw(14);
  int near = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<Vec3> points = draw.axis(i % 5 == 0 ? 1 + i % 150 : 40, draw.number(0.02, 0.15));
    const std::int32_t apart = 2 + i % 9;
    const SelfClearance found = self_clearance(points, kRadius_m, apart), truth = every_pair(points, kRadius_m, apart);
    EXPECT_EQ(found.nearest_m, truth.nearest_m);
    EXPECT_EQ(found.link, truth.link);
    EXPECT_EQ(found.other, truth.other);
    near += found.nearest_m < 0.05 ? 1 : 0;
  }
  EXPECT_GT(near, 300);
}

TEST(SelfClearance, OfAnArmTooShortToTouchItselfNamesNothing) {
  const SelfClearance found = self_clearance(Draw(15).axis(5, 0.1), kRadius_m, 5);
  EXPECT_EQ(found.link, -1);
  EXPECT_EQ(found.nearest_m, kNoObstacle_m);
}

// Capsules that lie to each other in ways a formula may stumble over; radii 0.
TEST(SelfClearance, OfTwoCapsulesHoldsWhereTheyAreAlignedOrPoints) {
  struct Case {
    const char* why;
    Vec3 a, a_end, b, b_end;
    double distance_m;
  };
  const Case cases[] = {
      {"crossing at right angles", {-1, 0, 0}, {1, 0, 0}, {0, -1, 0.5}, {0, 1, 0.5}, 0.5},
      {"crossing in one point", {-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, 0.0},
      {"parallel, side by side", {0, 0, 0}, {1, 0, 0}, {0.2, 0.3, 0}, {0.8, 0.3, 0}, 0.3},
      {"parallel and apart", {0, 0, 0}, {1, 0, 0}, {2, 0.3, 0}, {3, 0.3, 0}, std::hypot(1.0, 0.3)},
      {"parallel, against each other", {0, 0, 0}, {1, 0, 0}, {3, 0.3, 0}, {2, 0.3, 0}, std::hypot(1.0, 0.3)},
      {"on one line, apart", {0, 0, 0}, {1, 0, 0}, {1.25, 0, 0}, {2, 0, 0}, 0.25},
      {"on one line, overlapping", {0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}, {2, 0, 0}, 0.0},
      {"end to end", {0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, 0.0},
      {"a point and a piece", {0.5, 2, 0}, {0.5, 2, 0}, {0, 0, 0}, {1, 0, 0}, 2.0},
      {"a piece and a point beyond its end", {0, 0, 0}, {1, 0, 0}, {1.3, 0.4, 0}, {1.3, 0.4, 0}, 0.5},
      {"two points", {0, 0, 0}, {0, 0, 0}, {0, 3, 4}, {0, 3, 4}, 5.0},
      {"one point twice", {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, 0.0},
      {"nearly parallel", {0, 0, 0}, {1, 0, 0}, {0, 0.3, 0}, {1, 0.3 + 1e-9, 0}, 0.3},
      {"nearly parallel, meeting", {0, 0, 0}, {1, 0, 0}, {0, -1e-9, 0}, {1, 1e-9, 0}, 0.0},
  };
  for (const Case& c : cases) {
    EXPECT_NEAR(between_m({c.a, c.a_end, 0}, {c.b, c.b_end, 0}), c.distance_m, 1e-9) << c.why;
    EXPECT_NEAR(between_m({c.b, c.b_end, 0.1}, {c.a, c.a_end, 0.2}), c.distance_m - 0.3, 1e-9) << c.why;
  }
}

TEST(SelfClearance, LinksThatCannotTouchAreThoseWhoseJointsCannotBendByHalfATurn) {
  EXPECT_EQ(min_apart(20.0 * kDegree), 7);  // 6.36 joints of 28.3 deg about their diagonal
  EXPECT_EQ(min_apart(90.0 * kDegree), 2);
}

}  // namespace
}  // namespace liana::clearance
