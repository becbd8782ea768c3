#include "host/model/clearance/nearest_simplex.hpp"

namespace liana::clearance {
namespace {

constexpr double kFlat = 1e-12;

// Face of a simplex: its corners by number.
struct Face {
  std::array<int, 3> corner{};
  std::array<double, 3> weight{};
  int count = 0;
};

const Vec3& point(const Simplex& simplex, int i) { return simplex.corner[static_cast<std::size_t>(i)].between_m; }

Vec3 place_of(const Simplex& simplex, const Face& part) {
  Vec3 sum{};
  for (std::size_t k = 0; k < static_cast<std::size_t>(part.count); ++k)
    sum = add(sum, scale(point(simplex, part.corner[k]), part.weight[k]));
  return sum;
}

// The foot of the perpendicular from the origin, where it is within the edge.
bool edge(const Simplex& simplex, int i, int j, Face& out) {
  const Vec3 &p = point(simplex, i), along = subtract(point(simplex, j), p);
  const double length2 = dot(along, along), t = -dot(p, along);
  if (!(t > 0.0 && t < length2)) return false;
  out = {{i, j, 0}, {1.0 - t / length2, t / length2, 0.0}, 2};
  return true;
}

// The same for a triangle.
bool face(const Simplex& simplex, int i, int j, int k, Face& out) {
  const Vec3 &p = point(simplex, i), a = subtract(point(simplex, j), p), b = subtract(point(simplex, k), p);
  const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), pa = -dot(p, a), pb = -dot(p, b);
  const double area2 = aa * bb - ab * ab, s = pa * bb - pb * ab, t = pb * aa - pa * ab;
  if (!(s > 0.0 && t > 0.0 && s + t < area2)) return false;
  out = {{i, j, k}, {1.0 - (s + t) / area2, s / area2, t / area2}, 3};
  return true;
}

bool has_origin_inside(const Simplex& simplex) {
  const Vec3 &p = point(simplex, 0), a = subtract(point(simplex, 1), p), b = subtract(point(simplex, 2), p),
             c = subtract(point(simplex, 3), p), bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
  double volume = dot(a, bc), s = -dot(p, bc), t = -dot(p, ca), u = -dot(p, ab);
  if (volume < 0.0) volume = -volume, s = -s, t = -t, u = -u;
  const double flat = kFlat * norm(a) * norm(b) * norm(c);  // below it signs are noise, and a face is as near
  return volume > flat && s >= 0.0 && t >= 0.0 && u >= 0.0 && s + t + u <= volume;
}

void keep(const Face& part, const Vec3& nearest_m, Simplex& simplex) {
  const Simplex old = simplex;
  simplex.count = part.count;
  for (std::size_t k = 0; k < static_cast<std::size_t>(part.count); ++k) {
    simplex.corner[k] = old.corner[static_cast<std::size_t>(part.corner[k])];
    simplex.weight[k] = part.weight[k];
  }
  simplex.nearest_m = nearest_m;
}

}  // namespace

double Simplex::share() const {
  double sum = 0.0;
  for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) sum += weight[k] * corner[k].share;
  return sum;
}

bool reduce(Simplex& simplex) noexcept {
  if (simplex.count == 4 && has_origin_inside(simplex)) return false;
  Face best;
  Vec3 nearest_m{};
  double least2 = 1e300;
  const auto consider = [&](const Face& part) {
    const Vec3 place_m = place_of(simplex, part);
    const double here2 = dot(place_m, place_m);
    if (here2 < least2) least2 = here2, best = part, nearest_m = place_m;
  };
  Face part;
  for (int i = 0; i < simplex.count; ++i) {
    consider({{i, 0, 0}, {1.0, 0.0, 0.0}, 1});
    for (int j = i + 1; j < simplex.count; ++j) {
      if (edge(simplex, i, j, part)) consider(part);
      for (int k = j + 1; k < simplex.count; ++k) {
        if (face(simplex, i, j, k, part)) consider(part);
      }
    }
  }
  keep(best, nearest_m, simplex);
  return true;
}

}  // namespace liana::clearance
