// Convex bodies: what a link is from them, in cases that are easy to say and hard to compute. Random pairs against an
// exact reference: numbers.distances.
#include <gtest/gtest.h>

#include <cmath>

#include "host/model/clearance/clearance.hpp"
#include "tests/host/model/clearance/draw.hpp"

namespace liana::clearance {
namespace {

std::vector<Vec3> corners(const Vec3& half) {
  std::vector<Vec3> out;
  for (int i = 0; i < 8; ++i)
    out.push_back({(i & 1 ? 1 : -1) * half[0], (i & 2 ? 1 : -1) * half[1], (i & 4 ? 1 : -1) * half[2]});
  return out;
}

struct Case {
  const char* why;
  Capsule link;
  double distance_m;
};

void expect_distances(const config::SceneConvex& body, const std::vector<Case>& cases) {
  for (const Case& c : cases) {
    const Clearance found = clearance(c.link, body);
    EXPECT_NEAR(found.distance_m, c.distance_m, 1e-9) << c.why;
    EXPECT_NEAR(norm(found.normal), 1.0, 1e-12) << c.why;
    EXPECT_NEAR(dot(found.normal, subtract(found.on_axis_m, found.on_obstacle_m)), found.distance_m + c.link.radius_m,
                1e-9)
        << c.why;
  }
}

TEST(ConvexClearance, OfACubeOfPointsHoldsAtFacesEdgesCornersAndInLine) {
  expect_distances(config::hull_of("cube", corners({0.1, 0.1, 0.1})),
                   {{"a point before a face", {{0.3, 0.02, 0.01}, {0.3, 0.02, 0.01}, 0.0}, 0.2},
                    {"a point before a corner", {{0.2, 0.2, 0.2}, {0.2, 0.2, 0.2}, 0.05}, 0.1 * std::sqrt(3.0) - 0.05},
                    {"parallel to a face", {{0.3, -0.05, 0.0}, {0.3, 0.05, 0.0}, 0.03}, 0.17},
                    {"parallel to a face and longer", {{0.3, -5, 0.0}, {0.3, 5, 0.0}, 0.03}, 0.17},
                    {"parallel to an edge", {{0.2, 0.2, -0.5}, {0.2, 0.2, 0.5}, 0.0}, 0.1 * std::sqrt(2.0)},
                    {"in line with an edge", {{0.1, 0.1, 0.3}, {0.1, 0.1, 0.9}, 0.0}, 0.2},
                    {"in the plane of a face", {{0.1, 0.3, 0.0}, {0.1, 0.9, 0.0}, 0.0}, 0.2},
                    {"end on a face", {{0.1, 0.0, 0.0}, {0.5, 0.0, 0.0}, 0.0}, 0.0},
                    {"grazing an edge", {{0.0, 0.2, 0.0}, {0.2, 0.0, 0.0}, 0.0}, 0.0},
                    {"along a face", {{0.1, -0.5, 0.0}, {0.1, 0.5, 0.0}, 0.0}, 0.0},
                    {"its surface on a face", {{0.13, -0.5, 0.0}, {0.13, 0.5, 0.0}, 0.03}, 0.0},
                    {"an end inside", {{0.0, 0.0, 0.06}, {0.0, 0.0, 0.5}, 0.03}, -0.04 - 0.03}});
}

TEST(ConvexClearance, OfAHullDoesNotMindPointsTwiceInsideOrInOnePlane) {
  std::vector<Vec3> points = corners({0.1, 0.1, 0.1});
  for (const Vec3& p : corners({0.1, 0.1, 0.05})) points.push_back(p);
  for (const Vec3& p : corners({0.1, 0.1, 0.1})) points.push_back(p);
  points.push_back({0, 0, 0});
  expect_distances(config::hull_of("cube", points),
                   {{"a face", {{0.3, -1, 0.01}, {0.3, 1, 0.01}, 0.0}, 0.2},
                    {"an edge", {{0.2, 0.2, -1}, {0.2, 0.2, 1}, 0.0}, 0.1 * std::sqrt(2.0)},
                    {"touching", {{0.1, -1, 0.1}, {0.1, 1, 0.1}, 0.0}, 0.0}});
}

TEST(ConvexClearance, OfACylinderHoldsAtItsSideItsEndsAndItsRim) {
  expect_distances(config::cylinder("tank", {0, 0, -0.2}, {0, 0, 0.2}, 0.1),
                   {{"beside it, upright", {{0.3, 0, -1}, {0.3, 0, 1}, 0.03}, 0.17},
                    {"beside it, across", {{0.3, -1, 0.1}, {0.3, 1, 0.1}, 0.03}, 0.17},
                    {"above its end", {{-1, 0.02, 0.5}, {1, 0.02, 0.5}, 0.0}, 0.3},
                    {"on its axis", {{0, 0, 0.5}, {0, 0, 0.9}, 0.0}, 0.3},
                    {"before its rim", {{0.4, 0, 0.6}, {0.4, 0, 0.6}, 0.0}, 0.5},
                    {"through its middle", {{-1, 0, 0}, {1, 0, 0}, 0.0}, -0.1}});
}

TEST(ConvexClearance, OfACapsuleIsThatOfItsAxis) {
  expect_distances(config::capsule("hose", {0, 0, 0}, {1, 0, 0}, 0.02),
                   {{"parallel", {{0.2, 0.3, 0}, {0.8, 0.3, 0}, 0.03}, 0.25},
                    {"crossing over it", {{0.5, -1, 0.3}, {0.5, 1, 0.3}, 0.03}, 0.25},
                    {"in line", {{1.3, 0, 0}, {2, 0, 0}, 0.03}, 0.25},
                    {"crossing it", {{0.5, -1, 0}, {0.5, 1, 0}, 0.03}, -0.05}});
}

TEST(ConvexClearance, OfAThinPlateOfPointsIsNeverFreeOnItsOtherSide) {
  const config::SceneConvex plate = config::hull_of("foil", corners({0.5, 0.00001, 0.5}));
  EXPECT_NEAR(clearance({{0, -0.05, 0}, {0, -0.02, 0}, 0.0}, plate).distance_m, 0.01999, 1e-9);
  EXPECT_LE(clearance({{0, -0.05, 0}, {0, 0.05, 0}, 0.0}, plate).distance_m, 0.0);
  EXPECT_LE(clearance({{0.1, -1e-7, 0.3}, {0.1, 1e-7, 0.3}, 0.0}, plate).distance_m, 0.0);
}

// Inside, the depth is never less than the true one, which for a box has a closed form.
TEST(ConvexClearance, InsideIsAsDeepAsTheBoxOfTheSameCornersOrALittleMore) {
  Draw draw(31);
  const config::SceneBox box{"box", {0, 0, 0}, {0.3, 0.2, 0.1}, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  const config::SceneConvex hull = config::hull_of("hull", corners(box.half_extent_m));
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 from{draw.number(-0.3, 0.3), draw.number(-0.2, 0.2), draw.number(-0.1, 0.1)};
    const Capsule link{from, add(from, draw.place(0.02)), 0.03};
    const double exact_m = clearance(Capsule{from, from, 0.03}, box).distance_m;
    const double found_m = clearance(Capsule{from, from, 0.03}, hull).distance_m;
    EXPECT_LE(found_m, exact_m + 1e-12);
    EXPECT_GE(found_m, 1.05 * exact_m - 1e-12);
    EXPECT_LE(clearance(link, hull).distance_m, -0.03 + 1e-12);
    ++inside;
  }
  EXPECT_EQ(inside, 2000);
}

}  // namespace
}  // namespace liana::clearance
