// Distances of a straight piece from bodies, by looking at everything there is in long double: slow, simple, and with
// nothing in common with host/model/clearance. A hull is the union of the tetrahedra of its points, and every face of
// it is one of their triangles; so what is nearest lies on some triangle of three points, whichever those are.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::numbers {

using Real = long double;
using Point = std::array<Real, 3>;

inline Point point(const Vec3& v) { return {v[0], v[1], v[2]}; }
inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point along(const Point& a, const Point& way, Real t) {
  return {a[0] + t * way[0], a[1] + t * way[1], a[2] + t * way[2]};
}
inline Real inner(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point outer(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real length(const Point& a) { return std::sqrt(inner(a, a)); }

struct Piece {
  Point from, to;
};

inline Real point_piece(const Point& p, const Piece& piece) {
  const Point way = minus(piece.to, piece.from);
  const Real whole = inner(way, way);
  const Real t = whole > 0 ? std::clamp<Real>(inner(minus(p, piece.from), way) / whole, 0, 1) : 0;
  return length(minus(p, along(piece.from, way, t)));
}

// The ends of each against the other, and the insides against each other where both have the foot of the common
// perpendicular.
inline Real piece_piece(const Piece& a, const Piece& b) {
  Real least = std::min({point_piece(a.from, b), point_piece(a.to, b), point_piece(b.from, a), point_piece(b.to, a)});
  const Point u = minus(a.to, a.from), v = minus(b.to, b.from), w = minus(b.from, a.from), n = outer(u, v);
  const Real nn = inner(n, n);
  if (nn == 0) return least;
  const Real s = inner(outer(w, v), n) / nn, t = inner(outer(w, u), n) / nn;
  if (s > 0 && s < 1 && t > 0 && t < 1) least = std::min(least, std::fabs(inner(w, n)) / std::sqrt(nn));
  return least;
}

// Whether a point of the triangle's plane is in it.
inline bool is_in(const Point& p, const Point& a, const Point& b, const Point& c, const Point& n) {
  return inner(outer(minus(b, a), minus(p, a)), n) >= 0 && inner(outer(minus(c, b), minus(p, b)), n) >= 0 &&
         inner(outer(minus(a, c), minus(p, c)), n) >= 0;
}

inline Real piece_triangle(const Piece& piece, const Point& a, const Point& b, const Point& c) {
  Real least = std::min({piece_piece(piece, {a, b}), piece_piece(piece, {b, c}), piece_piece(piece, {c, a})});
  const Point n = outer(minus(b, a), minus(c, a));
  const Real nn = inner(n, n);
  if (nn == 0) return least;
  const Real from = inner(minus(piece.from, a), n), to = inner(minus(piece.to, a), n);
  for (const auto& [end, off] : {std::pair{piece.from, from}, std::pair{piece.to, to}}) {
    if (is_in(along(end, n, -off / nn), a, b, c, n)) least = std::min(least, std::fabs(off) / std::sqrt(nn));
  }
  if (from * to < 0 && is_in(along(piece.from, minus(piece.to, piece.from), from / (from - to)), a, b, c, n)) least = 0;
  return least;
}

// Not of tetrahedra that are flat but for a rounding of their corners.
inline bool is_in_tetrahedron(const Point& p, const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = minus(b, a), v = minus(c, a), w = minus(d, a);
  if (std::fabs(inner(u, outer(v, w))) < 1e-10L * length(u) * length(v) * length(w)) return false;
  const auto side = [&](const Point& q, const Point& r, const Point& s, const Point& inside) {
    const Point n = outer(minus(r, q), minus(s, q));
    const Real volume = inner(minus(inside, q), n);
    return volume != 0 && inner(minus(p, q), n) * volume >= 0;
  };
  return side(a, b, c, d) && side(a, b, d, c) && side(a, c, d, b) && side(b, c, d, a);
}

// 0 where they touch.
inline Real piece_hull(const Piece& piece, const std::vector<Point>& hull) {
  Real least = 1e30L;
  const std::size_t n = hull.size();
  for (std::size_t i = 0; i < n; ++i) {
    least = std::min(least, point_piece(hull[i], piece));
    for (std::size_t j = i + 1; j < n; ++j) {
      least = std::min(least, piece_piece(piece, {hull[i], hull[j]}));
      for (std::size_t k = j + 1; k < n; ++k) {
        least = std::min(least, piece_triangle(piece, hull[i], hull[j], hull[k]));
        for (std::size_t l = k + 1; l < n; ++l) {
          if (is_in_tetrahedron(piece.from, hull[i], hull[j], hull[k], hull[l])) return 0;
        }
      }
    }
  }
  return least;
}

// The distance of a point from a solid cylinder, and of a piece: it is convex along the piece, so a golden section
// finds it.
inline Real piece_cylinder(const Piece& piece, const Piece& axis, Real radius) {
  const Point way = minus(axis.to, axis.from);
  const Real whole = length(way);
  const auto at = [&](Real t) {
    const Point p = along(piece.from, minus(piece.to, piece.from), t), from = minus(p, axis.from);
    const Real up = inner(from, way) / whole;
    const Real off = length(minus(from, along({0, 0, 0}, way, up / whole)));
    return std::hypot(std::max<Real>(off - radius, 0), std::max<Real>({up - whole, -up, 0}));
  };
  const Real golden = (std::sqrt(5.0L) - 1) / 2;
  Real low = 0, high = 1;
  for (int i = 0; i < 100; ++i) {
    const Real a = high - golden * (high - low), b = low + golden * (high - low);
    (at(a) <= at(b) ? high : low) = at(a) <= at(b) ? b : a;
  }
  return std::min({at(0), at(1), at(low), at(high)});
}

}  // namespace liana::numbers
