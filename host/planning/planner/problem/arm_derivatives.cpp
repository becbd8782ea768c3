#include "host/planning/planner/problem/arm_derivatives.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;
using JetVec3 = std::array<Jet, 3>;
using JetQuat = std::array<Jet, 4>;

// One segment in the frame of its root.
struct LocalSegment {
  std::vector<JetVec3> point;  // ends of links, the root first
  JetQuat rotation;
};

// Rz(pitch) Ry(yaw): what an odd number of modules has more than the planar rotation.
JetQuat odd_module(const JetQuat& q, const Jet& pitch, const Jet& yaw) {
  const Jet ca = cos(0.5 * pitch), sa = sin(0.5 * pitch), cb = cos(0.5 * yaw), sb = sin(0.5 * yaw);
  const JetQuat o{ca * cb, -(sa * sb), ca * sb, sa * cb};
  return {q[0] * o[0] - q[1] * o[1] - q[2] * o[2] - q[3] * o[3], q[0] * o[1] + q[1] * o[0] + q[2] * o[3] - q[3] * o[2],
          q[0] * o[2] - q[1] * o[3] + q[2] * o[0] + q[3] * o[1], q[0] * o[3] + q[1] * o[2] - q[2] * o[1] + q[3] * o[0]};
}

// A base that feeds: no links, what it carries stands forward and turned.
LocalSegment local_base(const SegmentParams& base, double slide_rad, double roll_rad) {
  const Jet slide = pitch_variable(slide_rad), half = 0.5 * yaw_variable(roll_rad);
  return {{{base.slide_m_rad * slide, {}, {}}}, {cos(half), sin(half), {}, {}}};
}

LocalSegment local_segment(const SegmentParams& segment, double pitch_rad, double yaw_rad) {
  if (feeds(segment)) return local_base(segment, pitch_rad, yaw_rad);
  const Jet pitch = pitch_variable(pitch_rad), yaw = yaw_variable(yaw_rad);
  const Jet w = cos(pitch) * cos(yaw), y = sin(yaw), z = sin(pitch) * cos(yaw);
  const double l = segment.module_length_m;
  LocalSegment out;
  out.point.push_back({});
  out.rotation = {constant(1.0), {}, {}, {}};
  Jet T0 = constant(1.0), T1 = w, U0 = constant(0.0), U1 = constant(1.0);  // T_(k-1), T_k, U_(k-2), U_(k-1)
  for (std::int32_t k = 1; k <= segment.modules; ++k) {
    const JetVec3& last = out.point.back();
    out.point.push_back({last[0] + l * T1, last[1] + l * (U1 * z), last[2] - l * (U1 * y)});
    if (k == segment.modules / 2) out.rotation = {T1, {}, U1 * y, U1 * z};
    const Jet T2 = 2.0 * (w * T1) - T0, U2 = 2.0 * (w * U1) - U0;
    T0 = T1, T1 = T2;
    U0 = U1, U1 = U2;
  }
  if (segment.modules % 2 == 1) out.rotation = odd_module(out.rotation, pitch, yaw);
  return out;
}

Vec3 value(const JetVec3& v) { return {v[0].value, v[1].value, v[2].value}; }
Vec3 first(const JetVec3& v, Index i) { return {first(v[0], i), first(v[1], i), first(v[2], i)}; }
Vec3 second(const JetVec3& v, Index i, Index j) { return {second(v[0], i, j), second(v[1], i, j), second(v[2], i, j)}; }
Quat value(const JetQuat& q) { return {q[0].value, q[1].value, q[2].value, q[3].value}; }
Quat first(const JetQuat& q, Index i) { return {first(q[0], i), first(q[1], i), first(q[2], i), first(q[3], i)}; }
Quat second(const JetQuat& q, Index i, Index j) {
  return {second(q[0], i, j), second(q[1], i, j), second(q[2], i, j), second(q[3], i, j)};
}
Vec3 twice_vector(const Quat& q) { return {2.0 * q[1], 2.0 * q[2], 2.0 * q[3]}; }

double quat_dot(const Quat& a, const Quat& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

// Half of the quaternion product with a pure quaternion: how q turns with angular velocity v.
Quat half_turn(const Vec3& v, const Quat& q) { return multiply({0.0, 0.5 * v[0], 0.5 * v[1], 0.5 * v[2]}, q); }

}  // namespace

ArmDerivatives::ArmDerivatives(const RobotParams& table, const ThetaVector& theta_rad) {
  quaternion_.push_back({1.0, 0.0, 0.0, 0.0});
  origin_m_.push_back({0.0, 0.0, 0.0});
  first_link_.push_back(0);
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    LocalSegment local = local_segment(table.segment[m], theta_rad[2 * m], theta_rad[2 * m + 1]);
    const Quat root = quaternion_.back();
    const Quat q = value(local.rotation);
    const JetVec3& end = local.point.back();
    Segment segment;
    for (Index i = 0; i < 2; ++i) {
      segment.spin[i] = rotate(root, twice_vector(multiply(first(local.rotation, i), conjugate(q))));
      segment.end_rate[i] = rotate(root, first(end, i));
      for (Index j = 0; j < 2; ++j) {
        const Vec3 change = add(twice_vector(multiply(second(local.rotation, i, j), conjugate(q))),
                                twice_vector(multiply(first(local.rotation, j), conjugate(first(local.rotation, i)))));
        segment.spin_rate[i][j] = rotate(root, change);
        segment.end_second[i][j] = rotate(root, second(end, i, j));
      }
    }
    origin_m_.push_back(add(origin_m_.back(), rotate(root, value(end))));
    quaternion_.push_back(multiply(root, q));
    first_link_.push_back(first_link_.back() + table.segment[m].modules);
    segment.point = std::move(local.point);
    segment_.push_back(std::move(segment));
  }
}

ArmPoint ArmDerivatives::node(std::int32_t segment) const {
  return {first_link_[static_cast<Index>(segment)] - 1, 1.0};
}

ArmDerivatives::LocalPoint ArmDerivatives::local(const ArmPoint& where) const {
  Index m = 0;
  while (where.link >= first_link_[m + 1]) ++m;
  const Index k = static_cast<Index>(where.link - first_link_[m]);
  const JetVec3 &root = segment_[m].point[k], &end = segment_[m].point[k + 1];
  LocalPoint out{m, {}};
  for (Index i = 0; i < 3; ++i) out.jet[i] = (1.0 - where.share) * root[i] + where.share * end[i];
  return out;
}

PointDerivatives ArmDerivatives::point(const ArmPoint& where) const {
  const LocalPoint local_point = local(where);
  const Index m = local_point.segment;
  PointDerivatives out;
  out.position_m = add(origin_m_[m], rotate(quaternion_[m], value(local_point.jet)));
  for (Index i = 0; i < 2; ++i) out.by_theta[2 * m + i] = rotate(quaternion_[m], first(local_point.jet, i));
  for (Index n = 0; n < m; ++n) {
    const Vec3 lever = subtract(out.position_m, origin_m_[n + 1]);
    for (Index i = 0; i < 2; ++i)
      out.by_theta[2 * n + i] = add(segment_[n].end_rate[i], cross(segment_[n].spin[i], lever));
  }
  return out;
}

void ArmDerivatives::add_hessian(const ArmPoint& where, const PointDerivatives& at, const Vec3& weight,
                                 ThetaHessian& hessian) const {
  const LocalPoint local_point = local(where);
  const Index m = local_point.segment;
  const Vec3 local_weight = rotate(conjugate(quaternion_[m]), weight);
  for (Index i = 0; i < 2; ++i) {
    for (Index j = 0; j <= i; ++j)
      hessian[2 * m + i][2 * m + j] += liana::dot(local_weight, second(local_point.jet, i, j));
  }
  for (Index n = 0; n < m; ++n) {
    const Segment& segment = segment_[n];
    const Vec3 lever = subtract(at.position_m, origin_m_[n + 1]);
    for (Index i = 0; i < 2; ++i) {
      const Vec3 turned = cross(weight, segment.spin[i]);  // weight . (spin x v) = turned . v
      for (Index k = 2 * n + 2; k < 2 * m + 2; ++k) hessian[k][2 * n + i] += liana::dot(turned, at.by_theta[k]);
      for (Index j = 0; j <= i; ++j) {
        const Vec3 turn =
            add(cross(segment.spin_rate[i][j], lever), cross(segment.spin[j], cross(segment.spin[i], lever)));
        hessian[2 * n + i][2 * n + j] += liana::dot(weight, add(segment.end_second[i][j], turn));
      }
    }
  }
}

std::array<Quat, kMaxTheta> ArmDerivatives::tip_quaternion_by_theta() const {
  std::array<Quat, kMaxTheta> out{};
  for (Index n = 0; n < segment_.size(); ++n) {
    for (Index i = 0; i < 2; ++i) out[2 * n + i] = half_turn(segment_[n].spin[i], tip_quaternion());
  }
  return out;
}

void ArmDerivatives::add_quaternion_hessian(const Quat& weight, ThetaHessian& hessian) const {
  const Quat& q = tip_quaternion();
  for (Index n = 0; n < segment_.size(); ++n) {
    for (Index i = 0; i < 2; ++i) {
      const Vec3& spin_i = segment_[n].spin[i];
      for (Index j = 0; j <= i; ++j) {
        const Quat both = half_turn(segment_[n].spin[j], half_turn(spin_i, q));
        hessian[2 * n + i][2 * n + j] +=
            quat_dot(weight, half_turn(segment_[n].spin_rate[i][j], q)) + quat_dot(weight, both);
      }
      for (Index l = n + 1; l < segment_.size(); ++l) {
        for (Index j = 0; j < 2; ++j) {
          const Vec3& spin_j = segment_[l].spin[j];  // turns with everything before it: d spin_j / di = spin_i x spin_j
          const Quat both = half_turn(spin_j, half_turn(spin_i, q));
          hessian[2 * l + j][2 * n + i] +=
              quat_dot(weight, half_turn(cross(spin_i, spin_j), q)) + quat_dot(weight, both);
        }
      }
    }
  }
}

CableDerivatives cable_derivatives(const RobotParams& table, const ThetaVector& theta_rad) {
  CableDerivatives out;
  for (Index m = 0; m < static_cast<Index>(table.segment_count); ++m) {
    for (Index c = 0; c < static_cast<Index>(table.segment[m].cables); ++c) {
      const double phase = table.segment[m].cable_phase_rad[c], r = table.segment[m].hole_radius_m;
      if (feeds(table.segment[m])) {
        const Jet way =
            feed_m_rad(table.segment[m])[c] * (c == 0 ? pitch_variable(theta_rad[0]) : yaw_variable(theta_rad[1]));
        out.length_m.push_back(way.value);
        out.by_segment_m.push_back({way});
        continue;
      }
      const double y = r * std::cos(phase), z = r * std::sin(phase);
      std::vector<Jet> parts;
      double length_m = 0.0;
      for (Index j = 0; j <= m; ++j) {
        const SegmentParams& passed = table.segment[j];
        if (feeds(passed)) {  // carries the cables' drums
          parts.push_back(constant(0.0));
          continue;
        }
        const double g = passed.face_offset_m;
        const Jet pitch = pitch_variable(theta_rad[2 * j]), yaw = yaw_variable(theta_rad[2 * j + 1]);
        const Jet sa = sin(pitch), ca = cos(pitch), sb = sin(yaw), cb = cos(yaw), one = constant(1.0);
        const Jet bracket = (-g * g) * (ca * cb) + (g * y) * (sa * (one + cb)) - (g * z) * (sb * (one + ca)) +
                            (y * y) * ca + (y * z) * (sa * sb) + (z * z) * cb;
        parts.push_back(passed.modules * sqrt(constant(2.0 * (g * g + r * r)) - 2.0 * bracket));
        const std::int32_t links = j == m ? passed.modules - 1 : passed.modules;  // the anchor is the last disc
        length_m += parts.back().value + links * (passed.module_length_m - 2.0 * g);
        if (j < m) length_m += g - table.segment[j + 1].face_offset_m;  // the next segment's disc ends the last link
      }
      out.length_m.push_back(length_m);
      out.by_segment_m.push_back(std::move(parts));
    }
  }
  return out;
}

}  // namespace liana::planner
