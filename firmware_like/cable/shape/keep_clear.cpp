#include "firmware_like/cable/shape/keep_clear.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

// Link ends of a segment (kinematics.hpp): end k lies at l (C, S z, -S y) in the frame of the root, C and S sums of
// Chebyshev polynomials.
struct LinkEnd {
  double C, S, dC, dS;  // derivatives by w
};

LinkEnd between(const LinkEnd& a, const LinkEnd& b, double share) noexcept {
  return {a.C + share * (b.C - a.C), a.S + share * (b.S - a.S), a.dC + share * (b.dC - a.dC),
          a.dS + share * (b.dS - a.dS)};
}

struct Segment {
  double w, y, z, length_m;
  std::array<LinkEnd, kMaxModules + 1> end;
  Index links;
};

Segment segment_of(const SegmentParams& table, const SegmentTrig& t) noexcept {
  Segment segment;
  const double w = t.cos_pitch * t.cos_yaw;
  segment.w = w, segment.y = t.sin_yaw, segment.z = t.sin_pitch * t.cos_yaw, segment.length_m = table.module_length_m;
  segment.links = static_cast<Index>(table.modules);
  segment.end[0] = LinkEnd{};
  double T0 = 1.0, T1 = w, U0 = 0.0, U1 = 1.0, dU0 = 0.0, dU1 = 0.0;  // T_(k-1), T_k, U_(k-2), U_(k-1)
  for (Index k = 1; k <= segment.links; ++k) {
    const LinkEnd& last = segment.end[k - 1];
    segment.end[k] = {last.C + T1, last.S + U1, last.dC + static_cast<double>(k) * U1, last.dS + dU1};
    const double T2 = 2.0 * w * T1 - T0, U2 = 2.0 * w * U1 - U0, dU2 = 2.0 * (U1 + w * dU1) - dU0;
    T0 = T1, T1 = T2, U0 = U1, U1 = U2, dU0 = dU1, dU1 = dU2;
  }
  return segment;
}

Vec3 place(const Segment& s, const LinkEnd& end) noexcept {
  return {s.length_m * end.C, s.length_m * end.S * s.z, -s.length_m * end.S * s.y};
}

// Point of a segment's axis that is nearest to a point, both in the frame of the segment's root.
struct Nearest {
  LinkEnd on_axis;
  double distance_m;
};

Nearest nearest_on(const Segment& segment, const Vec3& point) noexcept {
  Nearest nearest{segment.end[0], 1e300};
  for (Index k = 0; k < segment.links; ++k) {
    const Vec3 from = place(segment, segment.end[k]), along = subtract(place(segment, segment.end[k + 1]), from);
    const double share = clamp(dot(subtract(point, from), along) / dot(along, along), 0.0, 1.0);
    const double distance = norm(subtract(point, add(from, scale(along, share))));
    if (distance < nearest.distance_m) nearest = {between(segment.end[k], segment.end[k + 1], share), distance};
  }
  return nearest;
}

Vec3 in_root_frame(const Pose& root, const Vec3& point) noexcept {
  return rotate(conjugate(root.quaternion), subtract(point, root.position_m));
}

// Velocity of a point of the segment for its own pitch or yaw, in the frame of the root.
Vec3 own_column(const Segment& s, const LinkEnd& p, const SegmentTrig& t, bool yaw) noexcept {
  const double dw = yaw ? -t.cos_pitch * t.sin_yaw : -s.z;
  const double dy = yaw ? t.cos_yaw : 0.0;
  const double dz = yaw ? -t.sin_pitch * t.sin_yaw : s.w;
  const double l = s.length_m, dS = p.dS * dw;
  return {l * p.dC * dw, l * (dS * s.z + p.S * dz), -l * (dS * s.y + p.S * dy)};
}

// The push on segment m, whose nearest point is too near.
Pull push_of(const ArmKinematics& arm, const SegmentTrig& trig, Index m, const Segment& segment, const Nearest& nearest,
             const KeepClear& target) noexcept {
  const Pose& root = arm.node_in_base[m];
  const Vec3 point = add(root.position_m, rotate(root.quaternion, place(segment, nearest.on_axis)));
  Pull push;
  push.weight = target.weight;
  push.excess_m = target.distance_m - nearest.distance_m;
  push.distance_m = 0.0;
  push.towards = scale(subtract(point, target.centre_m), 1.0 / nearest.distance_m);
  push.columns = static_cast<std::int32_t>(2 * m + 2);
  const Vec3 lever = subtract(point, arm.tip_in_base.position_m);
  for (Index k = 0; k < 2 * m; ++k)
    push.column[k] = add(arm.tip_jacobian.linear[k], cross(arm.tip_jacobian.angular[k], lever));
  for (Index axis = 0; axis < 2; ++axis)
    push.column[2 * m + axis] = rotate(root.quaternion, own_column(segment, nearest.on_axis, trig, axis == 1));
  return push;
}

}  // namespace

bool is_used(const KeepClear& target) noexcept { return target.distance_m > 0.0 && target.weight > 0.0; }

double largest_weight(const KeepClearTargets& targets) noexcept {
  double largest = 0.0;
  for (const KeepClear& target : targets) {
    if (is_used(target)) largest = larger(largest, target.weight);
  }
  return largest;
}

double missing_clearance_m(const RobotParams& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                           const KeepClearTargets& targets) noexcept {
  const ArmTrig trig = arm_trig(table, theta_rad);
  double sum_m = 0.0;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    const Segment segment = segment_of(table.segment[m], trig[m]);
    for (const KeepClear& target : targets) {
      if (!is_used(target)) continue;
      const double distance = nearest_on(segment, in_root_frame(arm.node_in_base[m], target.centre_m)).distance_m;
      sum_m += target.weight * larger(0.0, target.distance_m - distance);
    }
  }
  return sum_m;
}

void add_clearance(const RobotParams& table, const SegmentTrig& trig, const ArmKinematics& arm, const KeepClear& target,
                   std::int32_t segment, PullSum& sum) noexcept {
  constexpr double kNoWay_m = 1e-9;  // nearer than this, no direction leads away
  const Index m = static_cast<Index>(segment);
  const Segment links = segment_of(table.segment[m], trig);
  const Nearest nearest = nearest_on(links, in_root_frame(arm.node_in_base[m], target.centre_m));
  if (nearest.distance_m >= target.distance_m || nearest.distance_m < kNoWay_m) return;
  add_pull(push_of(arm, trig, m, links, nearest, target), sum);
}

void add_clearance(const RobotParams& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                   const KeepClearTargets& targets, PullSum& sum) noexcept {
  const ArmTrig trig = arm_trig(table, theta_rad);
  for (const KeepClear& target : targets) {
    if (!is_used(target)) continue;
    for (std::int32_t m = 0; m < table.segment_count; ++m)
      add_clearance(table, trig[static_cast<Index>(m)], arm, target, m, sum);
  }
}

}  // namespace liana::cable
