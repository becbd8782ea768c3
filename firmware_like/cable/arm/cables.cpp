#include "firmware_like/cable/arm/cables.hpp"

#include <cmath>

#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cable {
namespace {

using Index = std::size_t;

// Squared hole-to-hole distance of one universal joint: a quadratic form of the hole (y, z) whose coefficients all
// cables share (formula in cables.hpp).
struct PathForm {
  double one, y, z, yy, yz, zz;
};

inline PathForm path_form(const SegmentTrig& t, double g) noexcept {
  const double sa = t.sin_pitch, ca = t.cos_pitch, sb = t.sin_yaw, cb = t.cos_yaw;
  return {2.0 * g * g * (1.0 + ca * cb),
          -2.0 * g * sa * (1.0 + cb),
          2.0 * g * sb * (1.0 + ca),
          2.0 * (1.0 - ca),
          -2.0 * sa * sb,
          2.0 * (1.0 - cb)};
}

// Never zero while |angle| < pi.
inline double distance_m(const PathForm& f, double y, double z) noexcept {
  return std::sqrt(f.one + y * (f.y + f.yy * y + f.yz * z) + z * (f.z + f.zz * z));
}

// Half the derivatives of the same form by (pitch, yaw).
struct SlopeForm {
  Pair one, y, z, yz, squares;  // the last one goes with (yy, zz): pitch has no zz, yaw no yy
};

inline SlopeForm slope_form(const SegmentTrig& t, double g) noexcept {
  const double sa = t.sin_pitch, ca = t.cos_pitch, sb = t.sin_yaw, cb = t.cos_yaw, g2 = g * g;
  return {Pair{-g2 * sa * cb, -g2 * ca * sb}, Pair{-g * ca * (1.0 + cb), g * sa * sb},
          Pair{-g * sb * sa, g * cb * (1.0 + ca)}, Pair{-ca * sb, -sa * cb}, Pair{sa, sb}};
}

// A planar bend turns every cable by the bend angle psi of the joint, cos psi = cos a cos b.
double bend_angle(const SegmentTrig& t) noexcept {
  const double y = t.sin_yaw, z = t.sin_pitch * t.cos_yaw;
  return arc_tangent(std::sqrt(y * y + z * z), t.cos_pitch * t.cos_yaw);
}

[[gnu::noinline]] void take_feed(const SegmentParams& base, const CableLayout& layout, const SegmentTrig& t,
                                 CableGeometry& out) noexcept {
  const std::array<double, 2> m_rad = feed_m_rad(base), theta_rad{t.sin_pitch, t.cos_pitch};
  for (Index i = 0; i < 2; ++i) {
    out.jacobian_m_rad[i][i] = m_rad[i];
    out.length_m[i] = out.part_m[i][0] = layout.zero_length_m[i] + m_rad[i] * theta_rad[i];
  }
}

}  // namespace

CableLayout cable_layout(const RobotParams& table) noexcept {
  CableLayout layout;
  Index cable = 0;
  for (std::int32_t m = 0; m < table.segment_count; ++m) {
    const SegmentParams& own = table.segment[static_cast<Index>(m)];
    if (feeds(own)) {
      layout.cable_count = table.feed_count();
      for (; cable < static_cast<Index>(layout.cable_count); ++cable)
        layout.zero_length_m[cable] = feed_m_rad(own)[cable] * own.theta_limit_rad;
      continue;
    }
    for (std::int32_t c = 0; c < own.cables; ++c, ++cable) {
      const SinCos phase = sin_cos(own.cable_phase_rad[static_cast<Index>(c)]);
      ++layout.cable_count;
      layout.segment[cable] = m;
      layout.hole_y_m[cable] = own.hole_radius_m * phase.cos;
      layout.hole_z_m[cable] = own.hole_radius_m * phase.sin;
      for (std::int32_t j = table.first_bending(); j <= m; ++j) {
        const SegmentParams& passed = table.segment[static_cast<Index>(j)];
        // The anchor is the last disc, so the last link of the own segment carries no cable.
        const std::int32_t links = j == m ? passed.modules - 1 : passed.modules;
        double& straight_m = layout.straight_m[cable][static_cast<Index>(j)];
        straight_m = links * (passed.module_length_m - 2.0 * passed.face_offset_m);
        // The disc at the end of a segment's last link belongs to the next segment.
        if (j < m) straight_m += passed.face_offset_m - table.segment[static_cast<Index>(j) + 1].face_offset_m;
        layout.zero_length_m[cable] += straight_m + passed.modules * 2.0 * passed.face_offset_m;
      }
    }
  }
  return layout;
}

void update_cable_geometry(const RobotParams& table, const CableLayout& layout, const ArmTrig& trig,
                           CableGeometry& out) noexcept {
  const Index segments = static_cast<Index>(table.segment_count);
  std::array<PathForm, kMaxSegments> path;
  std::array<SlopeForm, kMaxSegments> slope;
  for (Index j = 0; j < segments; ++j) {
    path[j] = path_form(trig[j], table.segment[j].face_offset_m);
    slope[j] = slope_form(trig[j], table.segment[j].face_offset_m);
  }
  const bool is_fed = feeds(table.segment[0]);
  if (is_fed) path[0] = PathForm{1.0, 0.0, 0.0, 0.0, 0.0, 0.0}, slope[0] = SlopeForm{};  // no modules: no part
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    const double y = layout.hole_y_m[c], z = layout.hole_z_m[c];
    const Pair squares{y * y, z * z};
    double length_m = 0.0;
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j) {
      const SlopeForm& s = slope[j];
      const double modules = table.segment[j].modules, d_m = distance_m(path[j], y, z);
      const Pair by = s.one + s.y * y + (s.z + s.yz * y) * z + s.squares * squares;
      store_pair(by * (modules / d_m), &out.jacobian_m_rad[c][2 * j]);
      out.part_m[c][j] = modules * d_m + layout.straight_m[c][j];
      length_m += out.part_m[c][j];
    }
    out.length_m[c] = length_m;
  }
  if (is_fed) take_feed(table.segment[0], layout, trig[0], out);
}

void update_cable_solver(const RobotParams& table, const CableGeometry& geometry, CableSolver& solver) noexcept {
  Index c = 0;
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) {
    CableSolver::Segment normal;
    for (const Index end = c + static_cast<Index>(table.segment[j].cables); c < end; ++c) {
      const double p = geometry.jacobian_m_rad[c][2 * j], q = geometry.jacobian_m_rad[c][2 * j + 1];
      normal.pp += p * p;
      normal.pq += p * q;
      normal.qq += q * q;
    }
    const double det = normal.pp * normal.qq - normal.pq * normal.pq;
    if (det > 1e-12 * normal.pp * normal.qq) normal.inverse_det = 1.0 / det;
    solver.segment[j] = normal;
  }
}

CableSolution solve_cables(const RobotParams& table, const CableGeometry& geometry, const CableSolver& solver,
                           const CableVector& change_m) noexcept {
  CableSolution out;
  ThetaVector& theta = out.theta_rad;
  Index first = 0;
  for (Index j = 0; j < static_cast<Index>(table.segment_count); ++j) {
    const Index end = first + static_cast<Index>(table.segment[j].cables);
    double by_pitch = 0.0, by_yaw = 0.0;
    for (Index c = first; c < end; ++c) {
      const double* const row = geometry.jacobian_m_rad[c].data();
      out.left_m[c] = change_m[c] - dot_pairs(row, theta.data(), j);
      by_pitch += row[2 * j] * out.left_m[c];
      by_yaw += row[2 * j + 1] * out.left_m[c];
    }
    const CableSolver::Segment& n = solver.segment[j];
    theta[2 * j] = (n.qq * by_pitch - n.pq * by_yaw) * n.inverse_det;
    theta[2 * j + 1] = (n.pp * by_yaw - n.pq * by_pitch) * n.inverse_det;
    for (; first < end; ++first)
      out.left_m[first] -= dot_pairs(&geometry.jacobian_m_rad[first][2 * j], &theta[2 * j], 1);
  }
  return out;
}

SegmentVector cable_wraps(const RobotParams& table, const ArmTrig& trig) noexcept {
  SegmentVector wrap_rad{};
  for (Index j = static_cast<Index>(table.first_bending()); j < static_cast<Index>(table.segment_count); ++j)
    wrap_rad[j] = table.segment[j].modules * bend_angle(trig[j]);
  return wrap_rad;
}

CableGeometry cable_geometry(const RobotParams& table, const CableLayout& layout, const ArmTrig& trig) noexcept {
  CableGeometry out;
  update_cable_geometry(table, layout, trig, out);
  return out;
}

}  // namespace liana::cable
