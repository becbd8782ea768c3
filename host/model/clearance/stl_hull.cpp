#include "host/model/clearance/stl_hull.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "host/base/file/in_file.hpp"
#include "host/model/clearance/clearance.hpp"
#include "host/model/config/convex_shape.hpp"

namespace liana::clearance {
namespace {

constexpr std::size_t kHeader = 84, kTriangle = 50, kNormal = 12;  // bytes of a binary file
constexpr double kInside = 1e-9;

static_assert(std::endian::native == std::endian::little, "binary STL is read as it stands");

[[noreturn]] void refuse(const std::string& why) { throw std::runtime_error(why); }

std::string read(const std::string& path) {
  const auto text = file::content_of(path);
  if (!text) refuse("cannot be read: allowed a file that can be: put it beside the scene's");
  return *text;
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

// Neither kind: what it lacks.
[[noreturn]] void refuse_file(const std::string& bytes) {
  const std::string size = std::to_string(bytes.size()) + " bytes";
  if (bytes.size() < kHeader) refuse("is no STL (" + size + "): allowed text that begins with solid, or binary STL");
  const auto count = std::size_t{value_at<std::uint32_t>(bytes, 80)};
  refuse("is cut off, or no STL: its header says " + std::to_string(count) + " triangles, which take " +
         std::to_string(kHeader + kTriangle * count) + " bytes, and it has " + size + ": export it again");
}

std::vector<Vec3> text_points(const std::string& bytes) {
  if (!bytes.starts_with("solid")) refuse_file(bytes);
  std::vector<Vec3> points;
  std::istringstream words(bytes);
  std::string word;
  while (words >> word) {
    if (word != "vertex") continue;
    Vec3& point = points.emplace_back();
    if (!(words >> point[0] >> point[1] >> point[2]))
      refuse("vertex " + std::to_string(points.size()) + " has no three numbers: export it again");
  }
  return points;
}

Vec3 farthest(const std::vector<Vec3>& points, const Vec3& direction) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Vec3& a, const Vec3& b) { return dot(a, direction) < dot(b, direction); });
}

double outside_m(const Vec3& point, const config::SceneConvex& hull) {
  return clearance(Capsule{point, point, 0.0}, hull).distance_m;
}

// Maps the box around the points to -1..1 on each axis, and back: hulls stay hulls.
class UnitBox {
 public:
  explicit UnitBox(const std::vector<Vec3>& points) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] =
          std::minmax_element(points.begin(), points.end(), [i](const Vec3& a, const Vec3& b) { return a[i] < b[i]; });
      center_[i] = 0.5 * ((*low)[i] + (*high)[i]);
      half_[i] = std::max(0.5 * ((*high)[i] - (*low)[i]), 1e-12);
    }
  }
  Vec3 in(const Vec3& p) const {
    return {(p[0] - center_[0]) / half_[0], (p[1] - center_[1]) / half_[1], (p[2] - center_[2]) / half_[2]};
  }
  Vec3 out(const Vec3& p) const {
    return {center_[0] + half_[0] * p[0], center_[1] + half_[1] * p[1], center_[2] + half_[2] * p[2]};
  }
  double largest_half() const { return std::max({half_[0], half_[1], half_[2]}); }

 private:
  Vec3 center_{}, half_{};
};

// The farthest points in directions spread evenly over the sphere, along a spiral by the golden angle.
std::vector<Vec3> spread_corners(const std::vector<Vec3>& points) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < config::kMaxHullPoints; ++i) {
    const double z = 1.0 - (2.0 * double(i) + 1.0) / double(config::kMaxHullPoints), flat = std::sqrt(1.0 - z * z);
    const double turn_rad = double(i) * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const Vec3 corner = farthest(points, {flat * std::cos(turn_rad), flat * std::sin(turn_rad), z});
    if (std::find(corners.begin(), corners.end(), corner) == corners.end()) corners.push_back(corner);
  }
  return corners;
}

// Fewer corners: those of a hull within, moved away from its middle until every point is inside. That widens the body,
// never the way past it.
std::vector<Vec3> simplified(const std::vector<Vec3>& points) {
  constexpr double kStep = 0.001;
  const UnitBox box(points);
  std::vector<Vec3> unit;
  for (const Vec3& point : points) unit.push_back(box.in(point));
  const std::vector<Vec3> within = spread_corners(unit);
  Vec3 middle{};
  for (const Vec3& corner : within) middle = add(middle, scale(corner, 1.0 / double(within.size())));
  std::erase_if(unit, [hull = config::hull_of("", within)](const Vec3& p) { return outside_m(p, hull) <= 0.0; });
  for (double factor = 1.0; factor <= 2.0; factor += kStep) {
    std::vector<Vec3> corners;
    double moved = 0.0;
    for (const Vec3& corner : within) {
      corners.push_back(box.out(add(middle, scale(subtract(corner, middle), factor))));
      moved = std::max(moved, norm(subtract(corners.back(), box.out(corner))));
    }
    if (moved > kMaxWidening * 2.0 * box.largest_half()) break;
    const config::SceneConvex hull = config::hull_of("", corners);
    std::erase_if(unit, [&](const Vec3& p) { return outside_m(box.out(p), hull) <= kInside; });
    if (unit.empty()) return corners;
  }
  refuse(
      "has a hull of over 256 corners, and with fewer it would grow by over 2 % of its size: export it coarser, or "
      "make several bodies of it");
}

// Grows a hull until every point is in it; what is added is the farthest point where one was outside.
std::vector<Vec3> corners_of(const std::vector<Vec3>& points) {
  config::SceneConvex hull = config::hull_of("", {farthest(points, {1, 0, 0})});
  for (const Vec3& point : points) {
    for (;;) {
      const Clearance outside = clearance(Capsule{point, point, 0.0}, hull);
      if (!(outside.distance_m > kInside)) break;
      if (hull.points_m.size() == config::kMaxHullPoints) return simplified(points);
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
  if (points.size() < 3) refuse("has no triangle: allowed 1 to 200000: export it again");
  if (points.size() > 3 * kMaxTriangles)
    refuse("has " + std::to_string(points.size() / 3) + " triangles: allowed 1 to 200000: export it coarser");
  for (const Vec3& point : points) {
    if (!(norm(point) < 1e6)) refuse("has a coordinate that is no number up to 1e6: export it again");
  }
  return corners_of(points);
}

}  // namespace liana::clearance
