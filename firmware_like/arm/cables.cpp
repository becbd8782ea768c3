#include "firmware_like/arm/cables.hpp"

#include <cmath>

#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana {
namespace {

using Index = std::size_t;

// Squared hole-to-hole distance of one universal joint: a quadratic form of the hole (y, z) whose coefficients all cables share (formula
// in cables.hpp), and half its derivatives by (pitch, yaw).
struct JointForm {
  double one, y, z, yy, yz, zz;
  Pair by_one, by_y, by_z, by_yz, by_squares;  // the last one goes with (yy, zz): pitch has no zz, yaw no yy
};

JointForm joint_form(const SegmentTrig& t, double g) noexcept {
  const double sa = t.sin_pitch, ca = t.cos_pitch, sb = t.sin_yaw, cb = t.cos_yaw, g2 = g * g;
  return {2.0 * g2 * (1.0 + ca * cb),
          -2.0 * g * sa * (1.0 + cb),
          2.0 * g * sb * (1.0 + ca),
          2.0 * (1.0 - ca),
          -2.0 * sa * sb,
          2.0 * (1.0 - cb),
          Pair{-g2 * sa * cb, -g2 * ca * sb},
          Pair{-g * ca * (1.0 + cb), g * sa * sb},
          Pair{-g * sb * sa, g * cb * (1.0 + ca)},
          Pair{-ca * sb, -sa * cb},
          Pair{sa, sb}};
}

// A planar bend turns every cable by the bend angle psi of the joint, cos psi = cos a cos b.
double bend_angle(const SegmentTrig& t) noexcept {
  const double y = t.sin_yaw, z = t.sin_pitch * t.cos_yaw;
  return arc_tangent(std::sqrt(y * y + z * z), t.cos_pitch * t.cos_yaw);
}

}  // namespace

CableLayout cable_layout(const RobotTable& table) noexcept {
  CableLayout layout;
  Index cable = 0;
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const SegmentTable& own = table.segment[static_cast<Index>(m)];
    for (std::int32_t c = 0; c < own.cables; ++c, ++cable) {
      const SinCos phase = sin_cos(own.cable_phase_rad[static_cast<Index>(c)]);
      ++layout.cable_count;
      layout.segment[cable] = m;
      layout.hole_y_m[cable] = table.hole_radius_m * phase.cos;
      layout.hole_z_m[cable] = table.hole_radius_m * phase.sin;
      for (std::int32_t j = 0; j <= m; ++j) {
        const SegmentTable& passed = table.segment[static_cast<Index>(j)];
        // The anchor is the last disc, so the last link of the own segment carries no cable.
        const std::int32_t links = j == m ? passed.modules - 1 : passed.modules;
        layout.straight_m[cable][static_cast<Index>(j)] = links * (passed.module_length_m - 2.0 * table.face_offset_m);
        layout.zero_length_m[cable] += layout.straight_m[cable][static_cast<Index>(j)] + passed.modules * 2.0 * table.face_offset_m;
      }
    }
  }
  return layout;
}

void update_cable_geometry(const RobotTable& table, const CableLayout& layout, const ArmTrig& trig, CableGeometry& out) noexcept {
  const Index segments = static_cast<Index>(table.segment_count);
  std::array<JointForm, kMaxSegments> form;
  for (Index j = 0; j < segments; ++j) form[j] = joint_form(trig[j], table.face_offset_m);
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    const double y = layout.hole_y_m[c], z = layout.hole_z_m[c], yy = y * y, yz = y * z, zz = z * z;
    double length_m = 0.0;
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j) {
      const JointForm& f = form[j];
      const double modules = table.segment[j].modules;
      // Never zero while |angle| < pi.
      const double d_m = std::sqrt(f.one + f.y * y + f.z * z + f.yy * yy + f.yz * yz + f.zz * zz);
      const Pair by = f.by_one + f.by_y * both(y) + f.by_z * both(z) + f.by_yz * both(yz) + f.by_squares * Pair{yy, zz};
      store_pair(both(modules / d_m) * by, &out.jacobian_m_rad[c][2 * j]);
      out.part_m[c][j] = modules * d_m + layout.straight_m[c][j];
      length_m += out.part_m[c][j];
    }
    out.length_m[c] = length_m;
  }
}

SegmentVector cable_wraps(const RobotTable& table, const ArmTrig& trig) noexcept {
  SegmentVector wrap_rad{};
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) wrap_rad[j] = table.segment[j].modules * bend_angle(trig[j]);
  return wrap_rad;
}

CableGeometry cable_geometry(const RobotTable& table, const CableLayout& layout, const ArmTrig& trig) noexcept {
  CableGeometry out;
  update_cable_geometry(table, layout, trig, out);
  return out;
}

}  // namespace liana
