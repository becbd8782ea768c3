#include "firmware_like/cable/arm/kinematics.hpp"

#include <cmath>

#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

// Direction of a segment: w = cos psi, (0, z, -y) the side it bends to (kinematics.hpp).
struct Bend {
  double w, y, z;
};
inline Bend bend_of(const SegmentTrig& t) noexcept {
  return {t.cos_pitch * t.cos_yaw, t.sin_yaw, t.sin_pitch * t.cos_yaw};
}

// Chebyshev sums of a segment of n modules: C = sum T_k, S = sum U_(k-1), k = 1..n, and T = T_h, U = U_(h-1) at h =
// floor(n / 2). All follow from U_(h-1) and U_h:
//   T_h = U_h - w U_(h-1),  T_(h+1) = w U_h - U_(h-1),
//   n = 2 h:      C = U_(h-1) (T_h + T_(h+1)),  S = U_(h-1) (U_(h-1) + U_h),
//   n = 2 h + 1:  C + T_n,  S + U_(n-1)  with T_n = 2 T_h T_(h+1) - w,  U_(n-1) = U_h^2 - U_(h-1)^2.
struct ChebyshevSums {
  double C, S, T, U;
  double T_next, U_next;  // T_(h+1), U_h
};

inline ChebyshevSums chebyshev_sums(double w, std::int32_t modules) noexcept {
  double U0 = 0.0, U1 = 1.0;  // U_(k-1), U_k
  for (std::int32_t k = modules / 2; k > 0; --k) {
    const double U2 = 2.0 * w * U1 - U0;
    U0 = U1, U1 = U2;
  }
  const double T0 = U1 - w * U0, T1 = w * U1 - U0;
  ChebyshevSums sums{U0 * (T0 + T1), U0 * (U0 + U1), T0, U0, T1, U1};
  if (modules % 2 == 1) {
    sums.C += 2.0 * T0 * T1 - w;
    sums.S += U1 * U1 - U0 * U0;
  }
  return sums;
}

// Their derivatives by w: dT_k = k U_(k-1), dU_k by the recurrence differentiated.
struct ChebyshevSlopes {
  double dC, dS, dT, dU;
};

inline ChebyshevSlopes chebyshev_slopes(double w, std::int32_t modules, const ChebyshevSums& c) noexcept {
  const std::int32_t half = modules / 2;
  double U0 = 0.0, U1 = 1.0, dU0 = 0.0, dU1 = 0.0;
  for (std::int32_t k = half; k > 0; --k) {
    const double U2 = 2.0 * w * U1 - U0, dU2 = 2.0 * (U1 + w * dU1) - dU0;
    U0 = U1, U1 = U2, dU0 = dU1, dU1 = dU2;
  }
  const double dT0 = half * U0, dT1 = (half + 1) * U1;
  ChebyshevSlopes d{dU0 * (c.T + c.T_next) + U0 * (dT0 + dT1), dU0 * (U0 + U1) + U0 * (dU0 + dU1), dT0, dU0};
  if (modules % 2 == 1) {
    d.dC += 2.0 * (dT0 * c.T_next + c.T * dT1) - 1.0;
    d.dS += 2.0 * (U1 * dU1 - U0 * dU0);
  }
  return d;
}

// Rows of a rotation matrix: cheaper than a quaternion from the second vector on.
struct Rotation {
  Vec3 x, y, z;
};

inline Rotation rotation_of(const Quat& q) noexcept {
  const double x2 = 2.0 * q[1], y2 = 2.0 * q[2], z2 = 2.0 * q[3];
  const double xx = x2 * q[1], yy = y2 * q[2], zz = z2 * q[3], xy = x2 * q[2], xz = x2 * q[3], yz = y2 * q[3];
  const double wx = x2 * q[0], wy = y2 * q[0], wz = z2 * q[0];
  return {{1.0 - yy - zz, xy - wz, xz + wy}, {xy + wz, 1.0 - xx - zz, yz - wx}, {xz - wy, yz + wx, 1.0 - xx - yy}};
}

inline Vec3 apply(const Rotation& r, const Vec3& v) noexcept { return {dot(r.x, v), dot(r.y, v), dot(r.z, v)}; }

// q (w, 0, y, z): the rotation of a segment has no x component.
inline Quat times_planar(const Quat& q, double w, double y, double z) noexcept {
  return {q[0] * w - q[2] * y - q[3] * z, q[1] * w + q[2] * z - q[3] * y, q[0] * y + q[2] * w - q[1] * z,
          q[0] * z + q[1] * y + q[3] * w};
}

// An odd number of modules ends with one Rz(pitch) Ry(yaw) more than the planar rotation has: its half angles.
Quat odd_module(const SegmentTrig& t) noexcept {
  const double ca = std::sqrt(0.5 * (1.0 + t.cos_pitch)), sa = 0.5 * t.sin_pitch / ca;
  const double cb = std::sqrt(0.5 * (1.0 + t.cos_yaw)), sb = 0.5 * t.sin_yaw / cb;
  return {ca * cb, -sa * sb, ca * sb, sa * cb};
}

bool is_odd(const SegmentParams& segment) noexcept { return segment.modules % 2 == 1; }

// A base that feeds: forward along x, then turned about it. In the frame it stands in.
// Not inlined, like fed_rates: arms on a fixed base keep their registers.
[[gnu::noinline]] Pose fed(const SegmentParams& base, const SegmentTrig& t) noexcept {
  const double c = std::sqrt(0.5 * (1.0 + t.cos_yaw));
  return {{base.slide_m_rad * t.sin_pitch, 0.0, 0.0}, {c, 0.5 * t.sin_yaw / c, 0.0, 0.0}};
}

// Pose of the end of a segment that starts at `root`, whose matrix is `frame`.
inline Pose segment_end(const SegmentParams& segment, const SegmentTrig& t, const Bend& bend, const ChebyshevSums& c,
                        const Pose& root, const Rotation& frame) noexcept {
  const double l = segment.module_length_m;
  const Vec3 along{l * c.C, l * c.S * bend.z, -l * c.S * bend.y};
  Pose end{add(root.position_m, apply(frame, along)), times_planar(root.quaternion, c.T, c.U * bend.y, c.U * bend.z)};
  if (is_odd(segment)) end.quaternion = multiply(end.quaternion, odd_module(t));
  return end;
}

// Velocity of a segment's end for its own (pitch, yaw), linear and angular.
struct PairVec {
  Pair x, y, z;
};
struct EndRates {
  PairVec linear, angular;
};

PairVec apply(const Rotation& r, const PairVec& v) noexcept {
  return {both(r.x[0]) * v.x + both(r.x[1]) * v.y + both(r.x[2]) * v.z,
          both(r.y[0]) * v.x + both(r.y[1]) * v.y + both(r.y[2]) * v.z,
          both(r.z[0]) * v.x + both(r.z[1]) * v.y + both(r.z[2]) * v.z};
}

// In the frame of the segment's root.
inline EndRates end_rates(const SegmentParams& segment, const SegmentTrig& t, const Bend& bend,
                          const ChebyshevSums& c) noexcept {
  const ChebyshevSlopes d = chebyshev_slopes(bend.w, segment.modules, c);
  const Pair dw{-bend.z, -t.cos_pitch * t.sin_yaw}, dy{0.0, t.cos_yaw}, dz{bend.w, -t.sin_pitch * t.sin_yaw};
  const double l = segment.module_length_m, y = c.U * bend.y,
               z = c.U * bend.z;  // y, z of the segment's quaternion (T, 0, y, z)
  const Pair dS = d.dS * dw, dT = d.dT * dw, dU = d.dU * dw;
  const Pair qy = dU * bend.y + c.U * dy, qz = dU * bend.z + c.U * dz;  // their derivatives
  EndRates rates{{l * d.dC * dw, l * (dS * bend.z + c.S * dz), -l * (dS * bend.y + c.S * dy)},
                 // twice the vector part of dq times the conjugate of q
                 {2.0 * (qz * y - qy * z), 2.0 * (qy * c.T - dT * y), 2.0 * (qz * c.T - dT * z)}};
  if (is_odd(segment)) {
    const PairVec axis{Pair{0.0, -t.sin_pitch}, Pair{0.0, t.cos_pitch}, Pair{1.0, 0.0}};
    const PairVec turned = apply(rotation_of({c.T, 0.0, y, z}), axis);
    rates.angular = {rates.angular.x + turned.x, rates.angular.y + turned.y, rates.angular.z + turned.z};
  }
  return rates;
}

// What the slide moves and the roll turns.
[[gnu::noinline]] EndRates fed_rates(const SegmentParams& base) noexcept {
  EndRates rates{};
  rates.linear.x = Pair{base.slide_m_rad, 0.0};
  rates.angular.x = Pair{0.0, 1.0};
  return rates;
}

// Columns of the tip for a segment whose end is `lever` away from it.
void put_columns(const EndRates& end, const Vec3& lever, Index first, Jacobian& J) noexcept {
  const PairVec& w = end.angular;
  const PairVec tip{end.linear.x + (w.y * lever[2] - w.z * lever[1]), end.linear.y + (w.z * lever[0] - w.x * lever[2]),
                    end.linear.z + (w.x * lever[1] - w.y * lever[0])};
  for (Index axis = 0; axis < 2; ++axis) {
    J.linear[first + axis] = {tip.x[axis], tip.y[axis], tip.z[axis]};
    J.angular[first + axis] = {w.x[axis], w.y[axis], w.z[axis]};
  }
}

}  // namespace

void update_trig(const RobotParams& table, const ThetaVector& theta_rad, ArmTrig& trig) noexcept {
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    const SinCosOf<Pair> angle = sin_cos(load_pair(&theta_rad[2 * m]));
    trig[m] = {angle.sin[0], angle.cos[0], angle.sin[1], angle.cos[1]};
  }
  if (feeds(table.segment[0])) trig[0].sin_pitch = theta_rad[0], trig[0].cos_pitch = theta_rad[1];
}

ArmTrig arm_trig(const RobotParams& table, const ThetaVector& theta_rad) noexcept {
  ArmTrig trig{};
  update_trig(table, theta_rad, trig);
  return trig;
}

void update_kinematics(const RobotParams& table, const ArmTrig& trig, ArmKinematics& out) noexcept {
  const Index segments = static_cast<Index>(table.segment_count);
  std::array<EndRates, kMaxSegments> end;
  const bool is_fed = feeds(table.segment[0]);
  if (is_fed) out.node_in_base[0] = fed(table.segment[0], trig[0]);  // it has no modules: node 1 is there, too
  for (Index i = 0; i < segments; ++i) {
    const SegmentParams& segment = table.segment[i];
    const Bend bend = bend_of(trig[i]);
    const ChebyshevSums sums = chebyshev_sums(bend.w, segment.modules);
    const Pose& root = out.node_in_base[i];
    const Rotation frame = rotation_of(root.quaternion);
    const EndRates rates = end_rates(segment, trig[i], bend, sums);
    end[i] = {apply(frame, rates.linear), apply(frame, rates.angular)};
    out.node_in_base[i + 1] = segment_end(segment, trig[i], bend, sums, root, frame);
  }
  if (is_fed) end[0] = fed_rates(table.segment[0]);
  out.tip_in_base = out.node_in_base[segments];
  for (Index i = 0; i < segments; ++i) {
    put_columns(end[i], subtract(out.tip_in_base.position_m, out.node_in_base[i + 1].position_m), 2 * i,
                out.tip_jacobian);
  }
}

ArmKinematics forward_kinematics(const RobotParams& table, const ArmTrig& trig) noexcept {
  ArmKinematics out;
  update_kinematics(table, trig, out);
  return out;
}

Pose tip_pose(const RobotParams& table, const ArmTrig& trig) noexcept {
  Pose tip;
  if (feeds(table.segment[0])) tip = fed(table.segment[0], trig[0]);
  for (Index i = 0; i < static_cast<Index>(table.segment_count); ++i) {
    const SegmentParams& segment = table.segment[i];
    const Bend bend = bend_of(trig[i]);
    tip =
        segment_end(segment, trig[i], bend, chebyshev_sums(bend.w, segment.modules), tip, rotation_of(tip.quaternion));
  }
  return tip;
}

ArmKinematics forward_kinematics(const RobotParams& table, const ThetaVector& theta_rad) noexcept {
  return forward_kinematics(table, arm_trig(table, theta_rad));
}

Vec3 node_jacobian_column(const ArmKinematics& kinematics, std::int32_t node, std::int32_t column) noexcept {
  if (column >= 2 * node) return {0.0, 0.0, 0.0};
  const Vec3 lever =
      subtract(kinematics.node_in_base[static_cast<Index>(node)].position_m, kinematics.tip_in_base.position_m);
  const Index k = static_cast<Index>(column);
  return add(kinematics.tip_jacobian.linear[k], cross(kinematics.tip_jacobian.angular[k], lever));
}

LinkPoints link_points(const RobotParams& table, const ThetaVector& theta_rad) noexcept {
  LinkPoints out;
  const ArmTrig trig = arm_trig(table, theta_rad);
  const ArmKinematics arm = forward_kinematics(table, trig);
  out.count = 1;
  out.point_in_base[0] = arm.node_in_base[0].position_m;
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const Index i = static_cast<Index>(m);
    const SegmentTrig& t = trig[i];
    const double w = t.cos_pitch * t.cos_yaw, y = t.sin_yaw, z = t.sin_pitch * t.cos_yaw;
    const double l = table.segment[i].module_length_m;
    const Pose& root = arm.node_in_base[i];
    Vec3 local{0.0, 0.0, 0.0};
    double T0 = 1.0, T1 = w, U0 = 0.0, U1 = 1.0;
    for (std::int32_t k = 1; k <= table.segment[i].modules; ++k) {
      local = add(local, {l * T1, l * U1 * z, -l * U1 * y});
      out.point_in_base[static_cast<Index>(out.count++)] = add(root.position_m, rotate(root.quaternion, local));
      const double T2 = 2.0 * w * T1 - T0, U2 = 2.0 * w * U1 - U0;
      T0 = T1, T1 = T2, U0 = U1, U1 = U2;
    }
  }
  return out;
}

}  // namespace liana::cable
