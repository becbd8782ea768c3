// Distance of a straight piece from the convex bodies of a scene.
#pragma once

#include "hil/config/scene_config.hpp"

namespace liana::bench {

// Between the piece from `a` to `b` and a solid body; 0 when they meet. A hull by Wolfe's point of least norm (1976) in
// the difference of the two, exact but for roundings; a cylinder by a golden section along the piece, to 1e-9 m.
double segment_convex_distance_m(const Vec3& a, const Vec3& b, const ConvexConfig& body);

}  // namespace liana::bench
