#include "host/model/clearance/stl_hull.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "host/model/clearance/clearance.hpp"
#include "host/model/config/convex_shape.hpp"

namespace liana::clearance {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50, kNormal = 12;  // bytes of a binary file
constexpr double kInside = 1e-9;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it stands");

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse("allowed a file that can be read: put it beside the scene's");
  return {std::istreambuf_iterator<char>(file), {}};
}

template <class T>
T value_at(const std::string& bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// Bytes 80..83 say how many triangles follow; a text file does not have the length that comes of it.
bool is_binary(const std::string& bytes) {
  return bytes.size() >= kHeader && bytes.size() == kHeader + kTriangle * value_at<std::uint32_t>(bytes, 80);
}

std::vector<Vec3> binary_points(const std::string& bytes) {
  std::vector<Vec3> points;
  for (std::size_t triangle = kHeader; triangle < bytes.size(); triangle += kTriangle) {
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Vec3& point = points.emplace_back();
      for (std::size_t i = 0; i < 3; ++i)
        point[i] = double(value_at<float>(bytes, triangle + kNormal + corner * 12 + 4 * i));
    }
  }
  return points;
}

std::vector<Vec3> text_points(const std::string& bytes) {
  std::vector<Vec3> points;
  std::istringstream words(bytes);
  std::string word;
  while (words >> word) {
    if (word != "vertex") continue;
    Vec3& point = points.emplace_back();
    if (!(words >> point[0] >> point[1] >> point[2]))
      refuse("allowed three numbers after every vertex: export it again");
  }
  return points;
}

Vec3 farthest(const std::vector<Vec3>& points, const Vec3& direction) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vec3& a, const Vec3& b) { return dot(a, direction) < dot(b, direction); });
}

// Grows a hull until every point is in it; what is added is the farthest point where one was outside.
std::vector<Vec3> corners_of(const std::vector<Vec3>& points) {
  config::SceneConvex hull = config::hull_of("", {farthest(points, {1, 0, 0})});
  for (const Vec3& point : points) {
    for (;;) {
      const Clearance outside = clearance(Capsule{point, point, 0.0}, hull);
      if (!(outside.distance_m > kInside)) break;
      if (hull.points_m.size() == config::kMaxHullPoints)
        refuse("allowed a hull of 256 corners: export it coarser, or make several bodies of it");
      hull.points_m.push_back(farthest(points, outside.normal));
      hull = config::hull_of("", std::move(hull.points_m));
    }
  }
  return hull.points_m;
}

}  // namespace

std::vector<Vec3> stl_hull(const std::string& path) {
  const std::string bytes = read(path);
  const std::vector<Vec3> points = is_binary(bytes) ? binary_points(bytes) : text_points(bytes);
  if (points.size() < 3 || points.size() > 3 * kMaxTriangles)
    refuse("allowed an STL file of 1 to 200000 triangles: export it again");
  for (const Vec3& point : points) {
    if (!(norm(point) < 1e6)) refuse("allowed numbers up to 1e6: export it again");
  }
  return corners_of(points);
}

}  // namespace liana::clearance
