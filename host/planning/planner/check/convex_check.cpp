#include "host/planning/planner/check/convex_check.hpp"

#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>

#include "host/planning/planner/check/vectors.hpp"

namespace liana::planner {
namespace {

using Vector = std::array<double, 3>;
constexpr unsigned long kMaxIterations = 200;
constexpr double kSharp_m = 1e-6;

Vector beyond(const Vector& p, const Vector& way, double factor) {
  return {p[0] + factor * way[0], p[1] + factor * way[1], p[2] + factor * way[2]};
}

// A link's axis, swollen by a ball. Counts how often libccd asks: once in each iteration, and once before.
struct Swollen {
  Vector from, to;
  double radius_m;
  mutable unsigned long asked = 0;
};

void farthest_of_link(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* farthest) {
  const Swollen& link = *static_cast<const Swollen*>(object);
  ++link.asked;
  const Vector d{direction->v[0], direction->v[1], direction->v[2]};
  const Vector& end = product(d, link.to) > product(d, link.from) ? link.to : link.from;
  const Vector p = beyond(end, d, link.radius_m / std::sqrt(product(d, d)));
  ccdVec3Set(farthest, p[0], p[1], p[2]);
}

void farthest_of_body(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* farthest) {
  const config::SceneConvex& body = *static_cast<const config::SceneConvex*>(object);
  const Vector d{direction->v[0], direction->v[1], direction->v[2]};
  Vector p = *std::max_element(body.points_m.begin(), body.points_m.end(),
                               [&](const Vector& a, const Vector& b) { return product(a, d) < product(b, d); });
  const std::array<double, 2> in_disc{product(d, body.disc_axes[0]), product(d, body.disc_axes[1])};
  const double across = std::hypot(in_disc[0], in_disc[1]);
  for (std::size_t i = 0; i < 2 && across > 0.0; ++i)
    p = beyond(p, body.disc_axes[i], body.disc_radius_m * in_disc[i] / across);
  ccdVec3Set(farthest, p[0], p[1], p[2]);
}

bool touches(const Swollen& link, const config::SceneConvex& body) {
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = farthest_of_link;
  ccd.support2 = farthest_of_body;
  ccd.max_iterations = kMaxIterations;
  const bool touching = ccdGJKIntersect(&link, &body, &ccd) != 0;
  return touching || link.asked > kMaxIterations;  // libccd takes what it could not decide for apart
}

}  // namespace

double convex_distance_m(const Vector& from, const Vector& to, const config::SceneConvex& body, double enough) {
  const double apart_m = distance(beyond(from, beyond(to, from, -1.0), 0.5), body.center_m) - 0.5 * distance(from, to) -
                         std::hypot(body.half_extent_m[0], body.half_extent_m[1], body.half_extent_m[2]);
  if (apart_m >= enough) return enough;
  const double far_m = enough + body.round_m;
  double touching_m = distance(from, body.points_m.front()), free_m = 0.0;
  if (touching_m >= far_m) {
    if (!touches({from, to, far_m}, body)) return enough;
    touching_m = far_m;
  }
  if (touches({from, to, free_m}, body)) return -body.round_m;
  while (touching_m - free_m > kSharp_m) {
    const double middle_m = 0.5 * (free_m + touching_m);
    (touches({from, to, middle_m}, body) ? touching_m : free_m) = middle_m;
  }
  return free_m - body.round_m;
}

}  // namespace liana::planner
