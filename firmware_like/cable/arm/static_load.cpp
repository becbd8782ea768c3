#include "firmware_like/cable/arm/static_load.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

// Sum over a segment's modules of where their masses lie, in the frame of its root, and how it moves with pitch and
// yaw.
struct Moment {
  Vec3 sum_m{};
  std::array<Vec3, 2> per_rad_m{};
};

Moment moment_of(const SegmentParams& segment, const SegmentTrig& t) noexcept {
  const double w = t.cos_pitch * t.cos_yaw, y = t.sin_yaw, z = t.sin_pitch * t.cos_yaw;
  const std::int32_t n = segment.modules;
  double C = 0.0, S = 0.0, dC = 0.0, dS = 0.0;  // sums of T_k and U_(k-1), and their derivatives by w
  double T0 = 1.0, T1 = w, U0 = 0.0, U1 = 1.0;  // T_(k-1), T_k, U_(k-2), U_(k-1)
  double dU0 = 0.0, dU1 = 0.0;
  for (std::int32_t k = 1; k <= n; ++k) {
    const double weight = n - k + segment.module_center;
    C += weight * T1;
    S += weight * U1;
    dC += weight * k * U1;  // dT_k = k U_(k-1)
    dS += weight * dU1;
    const double T2 = 2.0 * w * T1 - T0, U2 = 2.0 * w * U1 - U0, dU2 = 2.0 * (U1 + w * dU1) - dU0;
    T0 = T1, T1 = T2, U0 = U1, U1 = U2, dU0 = dU1, dU1 = dU2;
  }
  const double l = segment.module_length_m;
  const std::array<double, 2> dw{-z, -t.cos_pitch * t.sin_yaw}, dy{0.0, t.cos_yaw}, dz{w, -t.sin_pitch * t.sin_yaw};
  Moment out{{l * C, l * S * z, -l * S * y}, {}};
  for (Index axis = 0; axis < 2; ++axis) {
    out.per_rad_m[axis] = {l * dC * dw[axis], l * (dS * dw[axis] * z + S * dz[axis]),
                           -l * (dS * dw[axis] * y + S * dy[axis])};
  }
  return out;
}

bool has_weight(const RobotParams& table) noexcept { return dot(table.gravity_m_s2, table.gravity_m_s2) > 0.0; }

void add_weight(const RobotParams& table, const ArmTrig& trig, const ArmKinematics& arm,
                ThetaVector& load_Nm) noexcept {
  const Vec3& tip_m = arm.tip_in_base.position_m;
  double beyond_kg = table.tool.mass_kg;
  Vec3 moment_kg_m = scale(add(tip_m, rotate(arm.tip_in_base.quaternion, table.tool.center_in_tip_m)), beyond_kg);
  for (Index j = static_cast<Index>(table.segment_count); j-- > 0;) {
    const SegmentParams& segment = table.segment[j];
    const Pose& root = arm.node_in_base[j];
    const Moment own = moment_of(segment, trig[j]);
    // All that lies beyond the segment moves with its end.
    const Vec3 lever_kg_m = subtract(moment_kg_m, scale(tip_m, beyond_kg));
    for (Index k = 2 * j; k < 2 * j + 2; ++k) {
      const Vec3 beyond =
          add(scale(arm.tip_jacobian.linear[k], beyond_kg), cross(arm.tip_jacobian.angular[k], lever_kg_m));
      const Vec3 moved = scale(rotate(root.quaternion, own.per_rad_m[k - 2 * j]), segment.module_mass_kg);
      load_Nm[k] -= dot(table.gravity_m_s2, add(beyond, moved));
    }
    const double own_kg = segment.modules * segment.module_mass_kg;
    moment_kg_m = add(moment_kg_m, scale(root.position_m, own_kg));
    moment_kg_m = add(moment_kg_m, scale(rotate(root.quaternion, own.sum_m), segment.module_mass_kg));
    beyond_kg += own_kg;
  }
}

}  // namespace

TipLoad joined(const TipLoad& a, const TipLoad& b) noexcept {
  const double mass_kg = a.mass_kg + b.mass_kg;
  if (!(mass_kg > 0.0)) return {0.0, a.center_in_tip_m};
  const Vec3 moment_kg_m = add(scale(a.center_in_tip_m, a.mass_kg), scale(b.center_in_tip_m, b.mass_kg));
  return {mass_kg, scale(moment_kg_m, 1.0 / mass_kg)};
}

bool has_static_load(const RobotParams& table) noexcept {
  bool has_springs = false;
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j)
    has_springs = has_springs || table.segment[j].joint_stiffness_Nm_rad > 0.0;
  return has_springs || has_weight(table);
}

ThetaVector static_load_Nm(const RobotParams& table, const ThetaVector& theta_rad, const ArmTrig& trig,
                           const ArmKinematics& arm) noexcept {
  ThetaVector load_Nm{};
  for (Index k = 0; k < static_cast<Index>(table.theta_count()); ++k) {
    const SegmentParams& segment = table.segment[k / 2];
    load_Nm[k] = segment.modules * segment.joint_stiffness_Nm_rad * (theta_rad[k] - segment.joint_rest_rad[k % 2]);
  }
  if (has_weight(table)) add_weight(table, trig, arm, load_Nm);
  return load_Nm;
}

TensionPlan plan_at_rest(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad) noexcept {
  if (!has_static_load(table)) return plan_at_rest(table, layout, theta_rad, ThetaVector{});
  const ArmTrig trig = arm_trig(table, theta_rad);
  return plan_at_rest(table, layout, theta_rad,
                      static_load_Nm(table, theta_rad, trig, forward_kinematics(table, trig)));
}

TensionPlan plan_at_rest(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad,
                         const ThetaVector& load_Nm) noexcept {
  const ArmTrig trig = arm_trig(table, theta_rad);
  const TensionRatio ratio = tension_ratio(table, layout, trig, SlipState{});
  return plan_tension(table, cable_geometry(table, layout, trig), ratio, SegmentVector{}, {load_Nm, {}});
}

}  // namespace liana::cable
