#include "firmware_like/arm/cables.hpp"

#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana {
namespace {

using Index = std::size_t;

struct HoleDistance {
  double length_m;
  double by_pitch, by_yaw;  // derivatives [m/rad]
};

// Hole-to-hole distance of one universal joint and its derivatives; never zero while |angle| < pi.
HoleDistance hole_distance(const SegmentTrig& t, double g, double y, double z) noexcept {
  const double sa = t.sin_pitch, ca = t.cos_pitch, sb = t.sin_yaw, cb = t.cos_yaw;
  const double bracket = -g * g * ca * cb + g * y * sa * (1.0 + cb) - g * z * sb * (1.0 + ca) + y * y * ca + y * z * sa * sb + z * z * cb;
  const double by_a = g * g * sa * cb + g * y * ca * (1.0 + cb) + g * z * sb * sa - y * y * sa + y * z * ca * sb;
  const double by_b = g * g * ca * sb - g * y * sa * sb - g * z * cb * (1.0 + ca) + y * z * sa * cb - z * z * sb;
  const double d = std::sqrt(2.0 * (g * g + y * y + z * z) - 2.0 * bracket);
  return {d, -by_a / d, -by_b / d};
}

}  // namespace

CableLayout cable_layout(const RobotTable& table) noexcept {
  CableLayout layout;
  Index cable = 0;
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const SegmentTable& own = table.segment[static_cast<Index>(m)];
    for (std::int32_t c = 0; c < own.cables; ++c, ++cable) {
      const SinCos phase = sin_cos(own.cable_phase_rad[static_cast<Index>(c)]);
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

CableGeometry cable_geometry(const RobotTable& table, const CableLayout& layout, const ArmTrig& trig) noexcept {
  CableGeometry out;
  const Index cables = static_cast<Index>(table.cable_count());
  for (Index c = 0; c < cables; ++c) {
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j) {
      const HoleDistance d = hole_distance(trig[j], table.face_offset_m, layout.hole_y_m[c], layout.hole_z_m[c]);
      const double n = table.segment[j].modules;
      out.part_m[c][j] = n * d.length_m + layout.straight_m[c][j];
      out.length_m[c] += out.part_m[c][j];
      out.jacobian_m_rad[c][2 * j] = n * d.by_pitch;
      out.jacobian_m_rad[c][2 * j + 1] = n * d.by_yaw;
    }
  }
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) {
    const SegmentTrig& t = trig[j];
    // A planar bend turns every cable by the bend angle psi of the joint; cos psi = cos a cos b.
    const double y = t.sin_yaw, z = t.sin_pitch * t.cos_yaw;
    out.wrap_rad[j] = table.segment[j].modules * arc_tangent(std::sqrt(y * y + z * z), t.cos_pitch * t.cos_yaw);
  }
  return out;
}

}  // namespace liana
