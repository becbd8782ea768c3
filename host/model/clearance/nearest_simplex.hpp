// The point of a point, line piece, triangle or tetrahedron that is nearest to the origin.
#pragma once

#include <array>

#include "firmware_like/math/pose.hpp"

namespace liana::clearance {

// A corner of the difference of two bodies: a point of the first less one of the second.
struct Corner {
  Vec3 between_m{};
  double share = 0.0;  // where on the link's axis the first is, 0 or 1
};

// Corners and what each counts in the nearest point; at most four.
struct Simplex {
  std::array<Corner, 4> corner{};
  std::array<double, 4> weight{};  // positive, together 1
  int count = 0;
  Vec3 nearest_m{};  // sum of weight times corner

  // Where on the link's axis the nearest point is, 0..1.
  double share() const;
};

// Keeps the corners that the nearest point is made of. False when the four corners have the origin between them; then
// nothing is changed. Looks at every corner, edge and face, so that corners in one line or plane do no harm.
bool reduce(Simplex& simplex) noexcept;

}  // namespace liana::clearance
