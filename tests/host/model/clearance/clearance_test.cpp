// Closed-form clearances against dense sampling of the link's axis, and their derivatives against differences.
#include "host/model/clearance/clearance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "tests/host/model/clearance/draw.hpp"
#include "tests/rounds.hpp"

namespace liana::clearance {
namespace {

constexpr int kCases = rounds(3000);
constexpr int kSamples = 2000;  // of the axis

double point_distance_m(const Vec3& p, const config::SceneSphere& sphere) {
  return norm(subtract(p, sphere.center_m)) - sphere.radius_m;
}

double point_distance_m(const Vec3& p, const config::SceneBox& box) {
  double outside2 = 0.0, inside = -1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const double face = std::fabs(dot(box.rotation[i], subtract(p, box.center_m))) - box.half_extent_m[i];
    outside2 += face > 0.0 ? face * face : 0.0;
    inside = std::max(inside, face);
  }
  return inside > 0.0 ? std::sqrt(outside2) : inside;
}

template <typename Obstacle>
double sampled_m(const Capsule& link, const Obstacle& obstacle) {
  double least = 1e300;
  for (int k = 0; k <= kSamples; ++k) {
    const Vec3 p = add(link.from_m, scale(subtract(link.to_m, link.from_m), static_cast<double>(k) / kSamples));
    least = std::min(least, point_distance_m(p, obstacle));
  }
  return least - link.radius_m;
}

// The closed form is never above the samples, and below the best of them by no more than one spacing allows.
template <typename Obstacle>
void expect_least(const Capsule& link, const Obstacle& obstacle) {
  const Clearance found = clearance(link, obstacle);
  const double sampled = sampled_m(link, obstacle);
  const double spacing_m = norm(subtract(link.to_m, link.from_m)) / kSamples;
  EXPECT_LE(found.distance_m, sampled + 1e-12);
  EXPECT_GE(found.distance_m, sampled - 0.5 * spacing_m - 1e-12);
  EXPECT_NEAR(norm(found.normal), 1.0, 1e-9);
  EXPECT_NEAR(norm(subtract(found.on_axis_m, add(link.from_m, scale(subtract(link.to_m, link.from_m), found.share)))),
              0.0, 1e-12);
  EXPECT_NEAR(point_distance_m(found.on_axis_m, obstacle), found.distance_m + link.radius_m, 1e-12);
  EXPECT_NEAR(point_distance_m(found.on_obstacle_m, obstacle), 0.0, 1e-12);
  EXPECT_NEAR(dot(found.normal, subtract(found.on_axis_m, found.on_obstacle_m)), found.distance_m + link.radius_m,
              1e-12);
}

TEST(Clearance, OfASphereIsTheLeastOfDenseSamples) {
  Draw draw(1);
  for (int i = 0; i < kCases; ++i) expect_least(draw.link(), draw.sphere());
}

TEST(Clearance, OfABoxIsTheLeastOfDenseSamplesInsideAndOutside) {
  Draw draw(2);
  int inside = 0;
  for (int i = 0; i < kCases; ++i) {
    const Capsule link = draw.link();
    const config::SceneBox box = draw.box();
    expect_least(link, box);
    inside += clearance(link, box).distance_m < -link.radius_m ? 1 : 0;
  }
  EXPECT_GT(inside, kCases / 20);
  EXPECT_LT(inside, kCases / 2);
}

TEST(Clearance, OfAPointIsTheOneOfTheSamples) {
  Draw draw(3);
  for (int i = 0; i < kCases; ++i) {
    Capsule link = draw.link();
    link.to_m = link.from_m;
    expect_least(link, draw.sphere());
    expect_least(link, draw.box());
  }
}

TEST(Clearance, OfALinkParallelToAFaceIsTheGap) {
  config::SceneBox plate{"plate", {0, 0, 0}, {1, 0.01, 2}, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  const Clearance found = clearance({{-0.2, 0.06, 0.3}, {0.2, 0.06, 0.3}, 0.03}, plate);
  EXPECT_NEAR(found.distance_m, 0.02, 1e-15);
  EXPECT_NEAR(found.normal[1], 1.0, 1e-15);
}

TEST(Clearance, OfALinkThroughAThinPlateIsHalfItsThicknessDeep) {
  config::SceneBox plate{"plate", {0, 0, 0}, {1, 0.01, 2}, {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}};
  const Clearance found = clearance({{0, -0.05, 0}, {0, 0.05, 0}, 0.03}, plate);
  EXPECT_NEAR(found.distance_m, -0.01 - 0.03, 1e-15);
  EXPECT_NEAR(found.share, 0.5, 1e-12);
}

// A central difference of the distance when both ends of the link move, against normal . dp(share).
template <typename Obstacle>
void expect_derivative(Draw& draw, const Capsule& link, const Obstacle& obstacle, int& compared) {
  constexpr double kStep = 1e-6;
  const Vec3 a = draw.place(1.0), b = draw.place(1.0);
  const auto moved = [&](double s) {
    return clearance(Capsule{add(link.from_m, scale(a, s)), add(link.to_m, scale(b, s)), link.radius_m}, obstacle);
  };
  const Clearance here = moved(0.0), before = moved(-kStep), after = moved(kStep);
  if (std::fabs(after.share - before.share) > 1e-3 || dot(after.normal, before.normal) < 0.999)
    return;                                      // two nearest points
  if (here.distance_m < -link.radius_m) return;  // inside, where the way out may jump
  const double expected = (after.distance_m - before.distance_m) / (2.0 * kStep);
  EXPECT_NEAR(dot(here.normal, add(scale(a, 1.0 - here.share), scale(b, here.share))), expected, 2e-4);
  ++compared;
}

TEST(Clearance, ChangesAsItsNormalSays) {
  Draw draw(4);
  int compared = 0;
  for (int i = 0; i < kCases; ++i) {
    const Capsule link = draw.link();
    expect_derivative(draw, link, draw.sphere(), compared);
    expect_derivative(draw, link, draw.box(), compared);
  }
  EXPECT_GT(compared, 2 * kCases * 9 / 10);
}

}  // namespace
}  // namespace liana::clearance
