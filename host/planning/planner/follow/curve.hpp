// A smooth curve in space for the tip: through given points, measured by its length.
#pragma once

#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::planner {

// A place on a curve.
struct CurvePlace {
  double along_m = 0.0;  // from the curve's beginning
  Vec3 position_m{};
  Vec3 tangent{};  // unit, forwards
};

class Curve {
 public:
  // Through at least two points, neighbours more than 1e-6 m apart: Catmull-Rom pieces with knots by chord length, so
  // that the direction has no jumps. Close points keep the curve as near to the straight lines between them as wanted.
  explicit Curve(const std::vector<Vec3>& points_m);

  double length_m() const { return along_m_.back(); }
  // The place at `along_m`, taken into 0..length_m.
  CurvePlace at(double along_m) const;
  // The place nearest to a point, of those from `from_m` to `until_m`, both taken into 0..length_m. Cost: one pass over
  // that part, a piece per 5 mm.
  CurvePlace nearest(const Vec3& point_m, double from_m, double until_m) const;

 private:
  std::vector<Vec3> sample_m_;
  std::vector<double> along_m_;  // per sample
};

}  // namespace liana::planner
