#include "hil/arm/convex_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace liana::bench {

namespace {

constexpr int kMaxDistanceRounds = 500;
constexpr double kRounding = 1e-13;  // of squares

// Corners whose plane, line or point is looked at, and the weights of a point in it.
struct Corral {
  std::array<Vec3, 5> corner;
  std::array<double, 5> weight{};
  std::size_t count = 0;

  Vec3 point() const {
    Vec3 sum;
    for (std::size_t i = 0; i < count; ++i) sum = sum + weight[i] * corner[i];
    return sum;
  }
};

// Weights, together 1, of the point of the corners' plane that is nearest to the origin: the normal equations with the
// sum as one more row, by elimination with pivots. False when the corners do not span a plane of their own.
bool nearest_of_plane(const Corral& corral, std::array<double, 5>& weight) {
  const std::size_t n = corral.count + 1;
  std::array<std::array<double, 7>, 6> row{};
  for (std::size_t i = 0; i < corral.count; ++i) {
    for (std::size_t k = 0; k < corral.count; ++k) row[i][k] = dot(corral.corner[i], corral.corner[k]);
    row[i][corral.count] = row[corral.count][i] = 1.0;
  }
  row[corral.count][n] = 1.0;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::fabs(row[r][c]) > std::fabs(row[pivot][c])) pivot = r;
    if (std::fabs(row[pivot][c]) < 1e-15) return false;
    std::swap(row[c], row[pivot]);
    for (std::size_t r = 0; r < n; ++r) {
      if (r == c) continue;
      const double factor = row[r][c] / row[c][c];
      for (std::size_t k = c; k <= n; ++k) row[r][k] -= factor * row[c][k];
    }
  }
  for (std::size_t i = 0; i < corral.count; ++i) weight[i] = row[i][n] / row[i][i];
  return true;
}

void drop(Corral& corral, std::size_t i) {
  --corral.count;
  corral.corner[i] = corral.corner[corral.count];
  corral.weight[i] = corral.weight[corral.count];
}

// Moves to the nearest point of the corners' plane, or as far as the weights stay positive; then without the corner
// that stops it, and again.
void settle(Corral& corral) {
  std::array<double, 5> wanted{};
  while (corral.count > 1) {
    if (!nearest_of_plane(corral, wanted)) return drop(corral, corral.count - 1);
    double share = 1.0;
    std::size_t first = corral.count;
    for (std::size_t i = 0; i < corral.count; ++i) {
      if (wanted[i] > 0.0) continue;
      const double here = corral.weight[i] / (corral.weight[i] - wanted[i]);
      if (first == corral.count || here < share) share = here, first = i;
    }
    for (std::size_t i = 0; i < corral.count; ++i) corral.weight[i] += share * (wanted[i] - corral.weight[i]);
    if (first == corral.count) return;
    drop(corral, first);
  }
  corral.weight[0] = 1.0;
}

double hull_distance_m(const Vec3& a, const Vec3& b, const std::vector<Vec3>& points) {
  Corral corral;
  corral.corner[0] = a - points[0];
  corral.weight[0] = 1.0;
  corral.count = 1;
  Vec3 nearest = corral.corner[0];
  for (int round = 0; round < kMaxDistanceRounds; ++round) {
    Vec3 least = corral.corner[0];
    for (const Vec3& point : points)
      for (const Vec3& corner : {a - point, b - point})
        if (dot(nearest, corner) < dot(nearest, least)) least = corner;
    const double square = dot(nearest, nearest);
    if (square - dot(nearest, least) <= kRounding || corral.count == 5) break;
    corral.corner[corral.count] = least;
    corral.weight[corral.count++] = 0.0;
    settle(corral);
    const Vec3 next = corral.point();
    if (!(dot(next, next) < square)) break;
    nearest = next;
  }
  return norm(nearest) < 1e-6 ? 0.0 : norm(nearest);
}

double point_cylinder_distance_m(const Vec3& p, const ConvexConfig& body) {
  const Vec3 axis = body.points_m[1] - body.points_m[0], from = p - body.points_m[0];
  const double length = norm(axis), up = dot(from, axis) / length;
  const double off = norm(from - (up / length) * axis) - body.radius_m;
  return std::hypot(std::max(off, 0.0), std::max({up - length, -up, 0.0}));
}

double cylinder_distance_m(const Vec3& a, const Vec3& b, const ConvexConfig& body) {
  constexpr double kGolden = 0.6180339887498949;
  const auto at = [&](double t) { return point_cylinder_distance_m(a + t * (b - a), body); };
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 45; ++i) {
    const double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
    if (at(left) <= at(right))
      high = right;
    else
      low = left;
  }
  return std::min({at(0.0), at(1.0), at(0.5 * (low + high))});
}

// The least of both ends against the other piece and, where both have it inside, the common perpendicular.
double segments_distance_m(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto to_piece = [](const Vec3& p, const Vec3& from, const Vec3& to) {
    const Vec3 way = to - from;
    const double whole = dot(way, way);
    const double t = whole > 0.0 ? std::clamp(dot(p - from, way) / whole, 0.0, 1.0) : 0.0;
    return norm(p - (from + t * way));
  };
  double least = std::min({to_piece(a, c, d), to_piece(b, c, d), to_piece(c, a, b), to_piece(d, a, b)});
  const Vec3 n = cross(b - a, d - c);
  const double nn = dot(n, n);
  if (nn == 0.0) return least;
  const double s = dot(cross(c - a, d - c), n) / nn, t = dot(cross(c - a, b - a), n) / nn;
  if (s > 0.0 && s < 1.0 && t > 0.0 && t < 1.0) least = std::min(least, std::fabs(dot(c - a, n)) / std::sqrt(nn));
  return least;
}

}  // namespace

double segment_convex_distance_m(const Vec3& a, const Vec3& b, const ConvexConfig& body) {
  switch (body.kind) {
    case ConvexConfig::Kind::cylinder:
      return cylinder_distance_m(a, b, body);
    case ConvexConfig::Kind::capsule:
      return std::max(0.0, segments_distance_m(a, b, body.points_m[0], body.points_m[1]) - body.radius_m);
    case ConvexConfig::Kind::hull:
      break;
  }
  return hull_distance_m(a, b, body.points_m);
}

}  // namespace liana::bench
