#include "firmware_like/math/pose.hpp"

#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana {

Quat normalize(const Quat& q) {
  const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
  if (!(length > 0.0) || !(length < 1e150)) return {1.0, 0.0, 0.0, 0.0};
  return {q[0] / length, q[1] / length, q[2] / length, q[3] / length};
}

Vec3 rotation_vector(const Quat& q) {
  const double sign = q[0] < 0.0 ? -1.0 : 1.0;  // the shorter way round
  const Vec3 v{sign * q[1], sign * q[2], sign * q[3]};
  const double s = norm(v);
  if (s > 0.05) return scale(v, 2.0 * arc_tangent(s, sign * q[0]) / s);
  const double x = s * s;  // arc sine of s over s; the first term left out is below 1e-17
  double p = 63.0 / 2816.0;
  p = p * x + 35.0 / 1152.0;
  p = p * x + 5.0 / 112.0;
  p = p * x + 3.0 / 40.0;
  p = p * x + 1.0 / 6.0;
  return scale(v, 2.0 + 2.0 * p * x);
}

Quat quaternion_of(const Vec3& rotation_vector_rad) {
  const double angle = norm(rotation_vector_rad);
  if (angle < 1e-12) {
    return normalize({1.0, 0.5 * rotation_vector_rad[0], 0.5 * rotation_vector_rad[1], 0.5 * rotation_vector_rad[2]});
  }
  const SinCos half = sin_cos(0.5 * angle);
  const Vec3 v = scale(rotation_vector_rad, half.sin / angle);
  return {half.cos, v[0], v[1], v[2]};
}

bool is_valid(const Pose& pose) {
  double sum = 0.0;
  for (double x : pose.position_m) sum += x * 0.0;
  double length2 = 0.0;
  for (double x : pose.quaternion) length2 += x * x;
  return sum == 0.0 && std::fabs(length2 - 1.0) <= 2e-6;  // NaN and infinity make both comparisons false
}

}  // namespace liana
