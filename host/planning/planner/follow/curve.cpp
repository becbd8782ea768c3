#include "host/planning/planner/follow/curve.hpp"

#include <algorithm>
#include <cmath>

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kPiece_m = 0.005;  // of the straight pieces that stand for the curve

double distance(const Vec3& a, const Vec3& b) { return norm(subtract(a, b)); }

Vec3 point_between(const Vec3& a, const Vec3& b, double share) { return add(scale(a, 1.0 - share), scale(b, share)); }

// Slope by chord length at every point: from the parabola through it and its neighbours; at the ends that of the first
// and last chord.
std::vector<Vec3> slopes(const std::vector<Vec3>& points) {
  std::vector<Vec3> chord;
  for (Index i = 0; i + 1 < points.size(); ++i) {
    chord.push_back(scale(subtract(points[i + 1], points[i]), 1.0 / distance(points[i], points[i + 1])));
  }
  std::vector<Vec3> out{chord.front()};
  for (Index i = 1; i + 1 < points.size(); ++i) {
    const double before = distance(points[i - 1], points[i]), after = distance(points[i], points[i + 1]);
    out.push_back(point_between(chord[i - 1], chord[i], before / (before + after)));
  }
  out.push_back(chord.back());
  return out;
}

// Cubic with given ends and end slopes at t (0..1), `chord_m` long.
Vec3 cubic(const Vec3& a, const Vec3& b, const Vec3& slope_a, const Vec3& slope_b, double chord_m, double t) {
  const double u = 1.0 - t;
  const Vec3 ends = add(scale(a, u * u * (1.0 + 2.0 * t)), scale(b, t * t * (3.0 - 2.0 * t)));
  return add(ends, scale(subtract(scale(slope_a, u), scale(slope_b, t)), chord_m * t * u));
}

}  // namespace

Curve::Curve(const std::vector<Vec3>& points_m) : sample_m_{points_m.front()}, along_m_{0.0} {
  const std::vector<Vec3> slope = slopes(points_m);
  for (Index i = 0; i + 1 < points_m.size(); ++i) {
    const double chord_m = distance(points_m[i], points_m[i + 1]);
    const int pieces = static_cast<int>(std::ceil(chord_m / kPiece_m));
    for (int s = 1; s <= pieces; ++s) {
      sample_m_.push_back(
          cubic(points_m[i], points_m[i + 1], slope[i], slope[i + 1], chord_m, static_cast<double>(s) / pieces));
      along_m_.push_back(along_m_.back() + distance(sample_m_.back(), sample_m_[sample_m_.size() - 2]));
    }
  }
}

CurvePlace Curve::at(double along_m) const {
  along_m = std::clamp(along_m, 0.0, length_m());
  const auto after = std::upper_bound(along_m_.begin() + 1, along_m_.end() - 1, along_m);
  const Index i = static_cast<Index>(after - along_m_.begin());
  const double share = (along_m - along_m_[i - 1]) / (along_m_[i] - along_m_[i - 1]);
  const Vec3 piece = subtract(sample_m_[i], sample_m_[i - 1]);
  return {along_m, point_between(sample_m_[i - 1], sample_m_[i], share), scale(piece, 1.0 / norm(piece))};
}

CurvePlace Curve::nearest(const Vec3& point_m, double from_m, double until_m) const {
  until_m = std::clamp(until_m, 0.0, length_m());
  from_m = std::clamp(from_m, 0.0, until_m);
  const auto after = std::upper_bound(along_m_.begin() + 1, along_m_.end() - 1, from_m);
  double best_m = 1e300, along_m = from_m;
  for (Index i = static_cast<Index>(after - along_m_.begin()) - 1; i + 1 < sample_m_.size() && along_m_[i] <= until_m;
       ++i) {
    const Vec3 piece = subtract(sample_m_[i + 1], sample_m_[i]);
    const double length_m = along_m_[i + 1] - along_m_[i];
    const double share = dot(subtract(point_m, sample_m_[i]), piece) / (length_m * length_m);
    const double here = std::clamp(along_m_[i] + std::clamp(share, 0.0, 1.0) * length_m, from_m, until_m);
    const double away_m =
        distance(point_m, point_between(sample_m_[i], sample_m_[i + 1], (here - along_m_[i]) / length_m));
    if (away_m < best_m) best_m = away_m, along_m = here;
  }
  return at(along_m);
}

}  // namespace liana::planner
