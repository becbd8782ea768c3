// Three-vectors, rotation matrices and poses of the bench. All in metres and radians, column vectors.
#pragma once

#include <array>
#include <cmath>

namespace liana::bench {

constexpr double kDegPerRad = 180.0 / 3.14159265358979323846;

// A vector in some frame named by its user.
struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) { return std::sqrt(dot(a, a)); }

// Unit quaternion, w first.
struct Quat {
  double w = 1.0;
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

inline Quat conjugate(const Quat& q) { return {q.w, -q.x, -q.y, -q.z}; }
inline Quat operator*(const Quat& a, const Quat& b) {
  return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
          a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
// The vector turned by q.
inline Vec3 rotate(const Quat& q, const Vec3& v) {
  const Vec3 u{q.x, q.y, q.z};
  const Vec3 t = 2.0 * cross(u, v);
  return v + q.w * t + cross(u, t);
}
// Rotation vector (axis times angle [rad]) to quaternion.
inline Quat from_rotation_vector(const Vec3& r) {
  const double angle = norm(r);
  if (angle < 1e-12) return {1.0, 0.5 * r.x, 0.5 * r.y, 0.5 * r.z};
  const double s = std::sin(0.5 * angle) / angle;
  return {std::cos(0.5 * angle), s * r.x, s * r.y, s * r.z};
}

// Position and attitude of a frame, seen from another.
struct Pose {
  Vec3 position_m;
  Quat attitude;
};

// Pose of b in a, when both are given in one common frame.
inline Pose relative(const Pose& a, const Pose& b) {
  const Quat inverse = conjugate(a.attitude);
  return {rotate(inverse, b.position_m - a.position_m), inverse * b.attitude};
}

// The other way round: pose of b in the common frame, when a is given in it and b in a.
inline Pose compose(const Pose& a, const Pose& b_in_a) {
  return {a.position_m + rotate(a.attitude, b_in_a.position_m), a.attitude * b_in_a.attitude};
}

// By how much a rotation turns [rad].
inline double angle_of(const Quat& q) { return 2.0 * std::atan2(norm({q.x, q.y, q.z}), std::fabs(q.w)); }

}  // namespace liana::bench
