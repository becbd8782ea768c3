#include "firmware_like/arm/kinematics.hpp"

#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana {
namespace {

using Index = std::size_t;

// One segment in the frame of its root, with derivatives by pitch [0] and yaw [1].
struct SegmentMotion {
  Quat rotation;
  Vec3 tip_m;
  std::array<Vec3, 2> tip_rate;      // d tip / d angle
  std::array<Vec3, 2> angular_rate;  // angular velocity of the end per angle rate
};

// Chebyshev sums of a segment: C = sum T_k, S = sum U_(k-1), k = 1..n, with derivatives by w, and T_h, U_(h-1) at h = floor(n / 2).
struct ChebyshevSums {
  double C = 0.0, S = 0.0, dC = 0.0, dS = 0.0;
  double T_half = 1.0, U_half = 0.0, dT_half = 0.0, dU_half = 0.0;
};

ChebyshevSums chebyshev_sums(double w, std::int32_t modules) noexcept {
  ChebyshevSums sums;
  double T0 = 1.0, T1 = w;                          // T_(k-1), T_k
  double U0 = 0.0, U1 = 1.0, dU0 = 0.0, dU1 = 0.0;  // U_(k-2), U_(k-1) and derivatives
  const std::int32_t half = modules / 2;
  for (std::int32_t k = 1; k <= modules; ++k) {
    const double dT1 = k * U1;
    sums.C += T1;
    sums.S += U1;
    sums.dC += dT1;
    sums.dS += dU1;
    if (k == half) {
      sums.T_half = T1;
      sums.U_half = U1;
      sums.dT_half = dT1;
      sums.dU_half = dU1;
    }
    const double T2 = 2.0 * w * T1 - T0;
    const double U2 = 2.0 * w * U1 - U0;
    const double dU2 = 2.0 * U1 + 2.0 * w * dU1 - dU0;
    T0 = T1, T1 = T2;
    U0 = U1, U1 = U2;
    dU0 = dU1, dU1 = dU2;
  }
  return sums;
}

// An odd number of modules ends with one Rz(pitch) Ry(yaw) more than the planar rotation has.
void append_odd_module(const SegmentTrig& t, SegmentMotion& motion) noexcept {
  const double ca = std::sqrt(0.5 * (1.0 + t.cos_pitch)), sa = 0.5 * t.sin_pitch / ca;
  const double cb = std::sqrt(0.5 * (1.0 + t.cos_yaw)), sb = 0.5 * t.sin_yaw / cb;
  motion.angular_rate[0] = add(motion.angular_rate[0], rotate(motion.rotation, {0.0, 0.0, 1.0}));
  motion.angular_rate[1] = add(motion.angular_rate[1], rotate(motion.rotation, {-t.sin_pitch, t.cos_pitch, 0.0}));
  motion.rotation = multiply(motion.rotation, {ca * cb, -sa * sb, ca * sb, sa * cb});
}

SegmentMotion segment_motion(const SegmentTable& segment, const SegmentTrig& t) noexcept {
  const double w = t.cos_pitch * t.cos_yaw, y = t.sin_yaw, z = t.sin_pitch * t.cos_yaw;
  const std::array<double, 2> dw{-z, -t.cos_pitch * t.sin_yaw};
  const std::array<double, 2> dy{0.0, t.cos_yaw};
  const std::array<double, 2> dz{w, -t.sin_pitch * t.sin_yaw};
  const ChebyshevSums c = chebyshev_sums(w, segment.modules);
  const double l = segment.module_length_m;

  SegmentMotion motion;
  motion.tip_m = {l * c.C, l * c.S * z, -l * c.S * y};
  motion.rotation = {c.T_half, 0.0, c.U_half * y, c.U_half * z};
  for (Index i = 0; i < 2; ++i) {
    const double dS = c.dS * dw[i];
    motion.tip_rate[i] = {l * c.dC * dw[i], l * (dS * z + c.S * dz[i]), -l * (dS * y + c.S * dy[i])};
    const double dU = c.dU_half * dw[i];
    const Quat dq{c.dT_half * dw[i], 0.0, dU * y + c.U_half * dy[i], dU * z + c.U_half * dz[i]};
    const Quat spin = multiply(dq, conjugate(motion.rotation));  // half the angular velocity
    motion.angular_rate[i] = {2.0 * spin[1], 2.0 * spin[2], 2.0 * spin[3]};
  }
  if (segment.modules % 2 == 1) append_odd_module(t, motion);
  return motion;
}

}  // namespace

ArmTrig arm_trig(const RobotTable& table, const ThetaVector& theta_rad) noexcept {
  ArmTrig trig{};
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const SinCos pitch = sin_cos(theta_rad[static_cast<Index>(2 * m)]);
    const SinCos yaw = sin_cos(theta_rad[static_cast<Index>(2 * m + 1)]);
    trig[static_cast<Index>(m)] = {pitch.sin, pitch.cos, yaw.sin, yaw.cos};
  }
  return trig;
}

ArmKinematics forward_kinematics(const RobotTable& table, const ArmTrig& trig) noexcept {
  ArmKinematics out;
  Jacobian& J = out.tip_jacobian;
  // Columns first hold the velocity of the end of their own segment, then are carried to the tip.
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const Index i = static_cast<Index>(m);
    const SegmentMotion motion = segment_motion(table.segment[i], trig[i]);
    const Pose& root = out.node_in_base[i];
    Pose& end = out.node_in_base[i + 1];
    end.position_m = add(root.position_m, rotate(root.quaternion, motion.tip_m));
    end.quaternion = multiply(root.quaternion, motion.rotation);
    for (Index axis = 0; axis < 2; ++axis) {
      J.linear[2 * i + axis] = rotate(root.quaternion, motion.tip_rate[axis]);
      J.angular[2 * i + axis] = rotate(root.quaternion, motion.angular_rate[axis]);
    }
  }
  out.tip_in_base = out.node_in_base[static_cast<Index>(table.segment_count)];
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const Index i = static_cast<Index>(m);
    const Vec3 lever = subtract(out.tip_in_base.position_m, out.node_in_base[i + 1].position_m);
    for (Index k = 2 * i; k < 2 * i + 2; ++k) J.linear[k] = add(J.linear[k], cross(J.angular[k], lever));
  }
  return out;
}

ArmKinematics forward_kinematics(const RobotTable& table, const ThetaVector& theta_rad) noexcept {
  return forward_kinematics(table, arm_trig(table, theta_rad));
}

Vec3 node_jacobian_column(const ArmKinematics& kinematics, std::int32_t node, std::int32_t column) noexcept {
  if (column >= 2 * node) return {0.0, 0.0, 0.0};
  const Vec3 lever = subtract(kinematics.node_in_base[static_cast<Index>(node)].position_m, kinematics.tip_in_base.position_m);
  const Index k = static_cast<Index>(column);
  return add(kinematics.tip_jacobian.linear[k], cross(kinematics.tip_jacobian.angular[k], lever));
}

LinkPoints link_points(const RobotTable& table, const ThetaVector& theta_rad) noexcept {
  LinkPoints out;
  const ArmTrig trig = arm_trig(table, theta_rad);
  const ArmKinematics arm = forward_kinematics(table, trig);
  out.count = 1;
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

}  // namespace liana
