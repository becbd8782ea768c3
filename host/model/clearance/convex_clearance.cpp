// Capsule to convex body.
//
// For a unit normal n the gap between two bodies is how far the first lies beyond the second along n: the least n.x of
// the one less the largest n.y of the other. The distance of bodies that are apart is the largest gap of all normals,
// and so is minus the depth of bodies that overlap. Whatever normal is tried, its gap is proven; what is returned is
// the largest one found.
#include <algorithm>
#include <cmath>

#include "host/model/clearance/clearance.hpp"
#include "host/model/clearance/nearest_simplex.hpp"
#include "host/model/config/convex_shape.hpp"

namespace liana::clearance {
namespace {

constexpr double kClose_m = 1e-10;  // between the best gap and the nearest points: it is good enough

struct Gap {
  double gap_m = -1e300;
  Vec3 normal{0.0, 0.0, 1.0};
};

// The link's axis and the body without its ball, and what lies farthest apart in them.
class Pair {
 public:
  Pair(const Capsule& link, const config::SceneConvex& body) : link_(link), body_(body) {}

  // The corner of the difference that is least along the normal.
  Corner corner(const Vec3& normal) const {
    const double share = dot(normal, subtract(link_.to_m, link_.from_m)) < 0.0 ? 1.0 : 0.0;
    const Vec3& on_axis_m = share > 0.0 ? link_.to_m : link_.from_m;
    return {subtract(on_axis_m, config::farthest_point(body_, normal)), share};
  }

  Vec3 from_center() const { return subtract(scale(add(link_.from_m, link_.to_m), 0.5), body_.center_m); }

 private:
  const Capsule& link_;
  const config::SceneConvex& body_;
};

bool has(const Simplex& simplex, const Corner& corner) {
  for (int i = 0; i < simplex.count; ++i) {
    if (simplex.corner[static_cast<std::size_t>(i)].between_m == corner.between_m) return true;
  }
  return false;
}

// Nearest points of bodies that are apart. A gap of 0 or less means that no planes between them were found.
Gap largest_gap(const Pair& pair, double& share) {
  const Vec3 first = pair.from_center();
  Simplex simplex;
  simplex.corner[0] = pair.corner(dot(first, first) > 0.0 ? first : Vec3{0.0, 0.0, 1.0});
  simplex.count = 1;
  reduce(simplex);
  Gap best;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double distance_m = norm(simplex.nearest_m);
    if (!(distance_m > kClose_m)) break;
    const Vec3 normal = scale(simplex.nearest_m, 1.0 / distance_m);
    const Corner corner = pair.corner(normal);
    const double gap_m = dot(normal, corner.between_m);
    if (gap_m > best.gap_m) best = {gap_m, normal}, share = simplex.share();
    if (distance_m - best.gap_m < kClose_m || has(simplex, corner)) break;
    simplex.corner[static_cast<std::size_t>(simplex.count++)] = corner;
    if (!reduce(simplex)) break;
  }
  return best;
}

Gap gap_along(const Pair& pair, const Vec3& normal) { return {dot(normal, pair.corner(normal).between_m), normal}; }

// Two directions across a normal.
std::array<Vec3, 2> across(const Vec3& normal) {
  const Vec3 beside = std::fabs(normal[0]) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 first = cross(normal, beside), unit = scale(first, 1.0 / norm(first));
  return {unit, cross(normal, unit)};
}

// The way out of bodies that overlap: of 26 directions the best, then of its neighbours ever nearer.
Gap way_out(const Pair& pair) {
  Gap best;
  const auto consider = [&](const Vec3& direction) {
    const Gap here = gap_along(pair, scale(direction, 1.0 / norm(direction)));
    if (here.gap_m > best.gap_m) best = here;
  };
  for (int i = 0; i < 27; ++i) {
    if (i != 13) consider({i / 9 - 1.0, i / 3 % 3 - 1.0, i % 3 - 1.0});
  }
  for (double step = 0.3; step > 0.001; step *= 0.5) {
    const Vec3 from = best.normal;
    for (const Vec3& side : across(from)) {
      consider(add(from, scale(side, step)));
      consider(subtract(from, scale(side, step)));
    }
  }
  return best;
}

}  // namespace

Clearance clearance(const Capsule& link, const config::SceneConvex& body) noexcept {
  const Pair pair(link, body);
  Clearance out;
  Gap best = largest_gap(pair, out.share);
  if (!(best.gap_m > 0.0)) {
    best = way_out(pair);
    best.gap_m = std::min(best.gap_m, 0.0);
    out.share = pair.corner(best.normal).share;
  }
  const double distance_m = best.gap_m - body.round_m;
  out.on_axis_m = add(link.from_m, scale(subtract(link.to_m, link.from_m), out.share));
  out.normal = best.normal;
  out.on_obstacle_m = subtract(out.on_axis_m, scale(out.normal, distance_m));
  out.distance_m = distance_m - link.radius_m;
  return out;
}

}  // namespace liana::clearance
