// Hulls of STL files: whatever is simplified contains every point of the mesh.
#include "host/model/clearance/stl_hull.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>

#include "host/model/clearance/clearance.hpp"
#include "host/model/config/convex_shape.hpp"
#include "tests/message.hpp"

namespace liana::clearance {
namespace {

class StlHull : public testing::Test {
 protected:
  ~StlHull() override { std::filesystem::remove(path_); }
  std::vector<Vec3> hull_of_text(const std::string& text) {
    std::ofstream(path_, std::ios::binary) << text;
    return stl_hull(path_);
  }
  std::string why_not(const std::string& text) {
    try {
      hull_of_text(text);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
  std::string path_ = testing::TempDir() + "liana_hull_" + std::to_string(::getpid()) + ".stl";
};

std::string text_of(const std::vector<Vec3>& points) {
  std::string text = "solid\n";
  for (const Vec3& p : points) {
    char line[100];
    std::snprintf(line, sizeof line, "vertex %.17g %.17g %.17g\n", p[0], p[1], p[2]);
    text += line;
  }
  return text;
}

// Points on a random ellipsoid, turned by nothing, as flat as a plate or as long as a rod.
std::vector<Vec3> round_body(std::mt19937& random, const Vec3& half, std::size_t count) {
  std::normal_distribution<double> any;
  std::vector<Vec3> points;
  while (points.size() < count) {
    const Vec3 p{any(random), any(random), any(random)};
    const double length = norm(p);
    if (length > 1e-3)
      points.push_back({3 + half[0] * p[0] / length, half[1] * p[1] / length, half[2] * p[2] / length});
  }
  return points;
}

double outside(const Vec3& point, const config::SceneConvex& hull) {
  return clearance(Capsule{point, point, 0.0}, hull).distance_m;
}

TEST_F(StlHull, WithTooManyCornersIsSimplifiedOutwardsAndContainsTheMesh) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> exponent(-2.5, 0.0);
  for (int body = 0; body < 6; ++body) {
    const Vec3 half{std::pow(10.0, exponent(random)), std::pow(10.0, exponent(random)),
                    std::pow(10.0, exponent(random))};
    const std::vector<Vec3> points = round_body(random, half, 1200);
    const std::vector<Vec3> corners = hull_of_text(text_of(points));
    ASSERT_LE(corners.size(), config::kMaxHullPoints);
    const config::SceneConvex hull = config::hull_of("", corners);
    double worst = 0.0;
    for (const Vec3& point : points) worst = std::max(worst, outside(point, hull));
    EXPECT_LE(worst, 1e-9) << "body " << body;
    const double size = 2.0 * std::max({half[0], half[1], half[2]});
    for (const Vec3& corner : corners) {  // against the ellipsoid, which contains the mesh's own hull
      const Vec3 unit{(corner[0] - 3) / half[0], corner[1] / half[1], corner[2] / half[2]};
      EXPECT_LE((norm(unit) - 1.0) * std::max({half[0], half[1], half[2]}), kMaxWidening * size) << "body " << body;
    }
  }
}

TEST_F(StlHull, WithFewCornersHasThoseOfTheMeshAlone) {
  const std::vector<Vec3> cube{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0},      {0, 0, 1},
                               {1, 0, 1}, {0, 1, 1}, {1, 1, 1}, {0.5, 0.5, 0.5}};
  std::vector<Vec3> corners = hull_of_text(text_of(cube));
  EXPECT_EQ(corners.size(), 8u);
  for (const Vec3& corner : corners) EXPECT_NE(std::find(cube.begin(), cube.end() - 1, corner), cube.end() - 1);
}

TEST_F(StlHull, ARefusalNamesItsCause) {
  EXPECT_TRUE(names(why_not("no shape"), {"no STL", "8 bytes"}));
  std::string binary(84 + 50 * 2, '\0');
  binary[80] = 3;
  EXPECT_TRUE(names(why_not(binary), {"cut off", "3 triangles", "234", "184 bytes"}));
  EXPECT_TRUE(names(why_not("solid nothing"), {"no triangle", "1 to 200000"}));
  EXPECT_TRUE(names(why_not("solid vertex 1 2"), {"vertex 1", "numbers"}));
  EXPECT_TRUE(names(why_not("solid vertex 0 0 0 vertex 1 0 0 vertex 0 1e7 0"), {"1e6"}));
  std::filesystem::remove(path_);
  EXPECT_TRUE(names(
      [&] {
        try {
          stl_hull(path_);
        } catch (const std::runtime_error& error) {
          return std::string(error.what());
        }
        return std::string();
      }(),
      {"cannot be read"}));
}

}  // namespace
}  // namespace liana::clearance
