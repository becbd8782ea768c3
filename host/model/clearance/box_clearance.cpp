// Capsule to oriented box.
#include <algorithm>
#include <cmath>

#include "firmware_like/math/pose.hpp"
#include "host/model/clearance/clearance.hpp"

namespace liana::clearance {
namespace {

using Index = std::size_t;

// The axis of a link in a box's own frame: p(t) = start + t direction, 0 <= t <= 1.
struct BoxSegment {
  Vec3 start{};
  Vec3 direction{};
  Vec3 half{};

  Vec3 at(double t) const { return add(start, scale(direction, t)); }
};

BoxSegment into_frame(const Capsule& link, const config::SceneBox& box) {
  const Vec3 start = subtract(link.from_m, box.center_m), direction = subtract(link.to_m, link.from_m);
  BoxSegment segment;
  for (Index i = 0; i < 3; ++i) {
    segment.start[i] = dot(box.rotation[i], start);
    segment.direction[i] = dot(box.rotation[i], direction);
  }
  segment.half = box.half_extent_m;
  return segment;
}

// Half the derivative by t of the squared distance to the box; it never falls with t.
double slope(const BoxSegment& s, double t) {
  double sum = 0.0;
  for (Index i = 0; i < 3; ++i) {
    const double p = s.start[i] + t * s.direction[i];
    const double over = p - std::clamp(p, -s.half[i], s.half[i]);
    sum += over * s.direction[i];
  }
  return sum;
}

// Where a link outside the box is nearest: the zero of the slope, linear between the places where the axis passes a
// face's plane.
double nearest_outside(const BoxSegment& s) {
  double low = 0.0, high = 1.0;
  double at_low = slope(s, low), at_high = slope(s, high);
  if (at_low >= 0.0) return low;
  if (at_high <= 0.0) return high;
  for (Index i = 0; i < 3; ++i) {
    if (s.direction[i] == 0.0) continue;
    for (const double side : {-1.0, 1.0}) {
      const double t = (side * s.half[i] - s.start[i]) / s.direction[i];
      if (!(t > low && t < high)) continue;
      const double here = slope(s, t);
      (here < 0.0 ? low : high) = t;
      (here < 0.0 ? at_low : at_high) = here;
    }
  }
  return low + (high - low) * at_low / (at_low - at_high);
}

// Signed distance of a point that is inside: minus the depth to the nearest face; `axis` is that face's.
double depth_inside(const BoxSegment& s, double t, Index& axis) {
  const Vec3 p = s.at(t);
  double most = -1e300;
  for (Index i = 0; i < 3; ++i) {
    const double face = std::fabs(p[i]) - s.half[i];
    if (face > most) most = face, axis = i;
  }
  return most;
}

// The part of the axis that is inside the box; empty when from > to.
struct Part {
  double from = 0.0, to = 1.0;
};

Part part_inside(const BoxSegment& s) {
  Part part;
  for (Index i = 0; i < 3; ++i) {
    if (s.direction[i] == 0.0) {
      if (std::fabs(s.start[i]) > s.half[i]) return {1.0, 0.0};
      continue;
    }
    const double a = (-s.half[i] - s.start[i]) / s.direction[i], b = (s.half[i] - s.start[i]) / s.direction[i];
    part.from = std::max(part.from, std::min(a, b));
    part.to = std::min(part.to, std::max(a, b));
  }
  return part;
}

// Deepest point of the part inside. The depth is the maximum of six lines in t, so its minimum is at an end or where
// two lines cross.
double deepest_inside(const BoxSegment& s, const Part& part) {
  double best_t = part.from;
  Index axis = 0;
  double best = depth_inside(s, best_t, axis);
  const auto consider = [&](double t) {
    if (!(t > part.from && t <= part.to)) return;
    const double depth = depth_inside(s, t, axis);
    if (depth < best) best = depth, best_t = t;
  };
  consider(part.to);
  for (Index i = 0; i < 6; ++i) {
    for (Index j = i + 1; j < 6; ++j) {
      const double a = i % 2 == 0 ? 1.0 : -1.0, b = j % 2 == 0 ? 1.0 : -1.0;
      const Index m = i / 2, n = j / 2;
      const double rate = a * s.direction[m] - b * s.direction[n];
      if (rate != 0.0) consider((b * s.start[n] - s.half[n] - a * s.start[m] + s.half[m]) / rate);
    }
  }
  return best_t;
}

// A point of the box's frame, and a direction, in the base frame.
Vec3 direction_in_base(const config::SceneBox& box, const Vec3& v) {
  Vec3 out{};
  for (Index i = 0; i < 3; ++i) out = add(out, scale(box.rotation[i], v[i]));
  return out;
}

}  // namespace

Clearance clearance(const Capsule& link, const config::SceneBox& box) noexcept {
  const BoxSegment segment = into_frame(link, box);
  const Part inside = part_inside(segment);
  Clearance out;
  Vec3 normal{};
  double distance_m = 0.0;
  if (inside.from <= inside.to) {
    Index axis = 0;
    out.share = deepest_inside(segment, inside);
    distance_m = depth_inside(segment, out.share, axis);
    normal[axis] = segment.at(out.share)[axis] < 0.0 ? -1.0 : 1.0;
  } else {
    out.share = nearest_outside(segment);
    const Vec3 p = segment.at(out.share);
    for (Index i = 0; i < 3; ++i) normal[i] = p[i] - std::clamp(p[i], -segment.half[i], segment.half[i]);
    distance_m = norm(normal);
    normal = distance_m > 0.0 ? scale(normal, 1.0 / distance_m) : Vec3{1.0, 0.0, 0.0};
  }
  out.on_axis_m = add(link.from_m, scale(subtract(link.to_m, link.from_m), out.share));
  out.normal = direction_in_base(box, normal);
  out.on_obstacle_m = subtract(out.on_axis_m, scale(out.normal, distance_m));
  out.distance_m = distance_m - link.radius_m;
  return out;
}

}  // namespace liana::clearance
