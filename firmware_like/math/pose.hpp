// Rigid poses: unit quaternion (w, x, y, z) and position, in named frames.
#pragma once

#include <array>
#include <cmath>

#include "firmware_like/math/arithmetic.hpp"

namespace liana {

using Vec3 = std::array<double, 3>;
using Quat = std::array<double, 4>;  // w, x, y, z; unit length

// Pose of a frame in another: x_outer = rotate(quaternion, x_inner) + position_m.
struct Pose {
  Vec3 position_m{0.0, 0.0, 0.0};
  Quat quaternion{1.0, 0.0, 0.0, 0.0};
};

inline Vec3 add(const Vec3& a, const Vec3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vec3 subtract(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vec3 scale(const Vec3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
// Euclidean length.
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

inline Quat multiply(const Quat& a, const Quat& b) {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3], a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1], a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}
inline Quat conjugate(const Quat& q) { return {q[0], -q[1], -q[2], -q[3]}; }
inline Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 u{q[1], q[2], q[3]};
  const Vec3 t = scale(cross(u, v), 2.0);
  return add(add(v, scale(t, q[0])), cross(u, t));
}
// Quaternion scaled to unit length; the identity when it is zero or not finite.
Quat normalize(const Quat& q);
// Rotation vector (axis times angle, rad, |.| <= pi) of a unit quaternion.
Vec3 rotation_vector(const Quat& q);
// Unit quaternion of a rotation vector [rad], |v| <= 2 pi.
Quat quaternion_of(const Vec3& rotation_vector_rad);

inline Pose compose(const Pose& a, const Pose& b) {
  return {add(a.position_m, rotate(a.quaternion, b.position_m)), multiply(a.quaternion, b.quaternion)};
}
inline Pose inverse(const Pose& a) {
  const Quat c = conjugate(a.quaternion);
  return {rotate(c, scale(a.position_m, -1.0)), c};
}

// True when every number of the pose is finite and the quaternion's length is 1 within 1e-6.
bool is_valid(const Pose& pose);

}  // namespace liana
