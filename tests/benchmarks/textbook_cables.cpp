#include "tests/benchmarks/textbook_cables.hpp"

#include <cmath>

namespace liana::bench {
namespace {

constexpr double kStep_rad = 1e-5;

using Matrix3 = std::array<Vec3, 3>;  // rows

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 out{};
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) out[r][c] = a[r][0] * b[0][c] + a[r][1] * b[1][c] + a[r][2] * b[2][c];
  }
  return out;
}

Matrix3 about_z(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{c, -s, 0.0}, {s, c, 0.0}, {0.0, 0.0, 1.0}}};
}

Matrix3 about_y(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{{c, 0.0, s}, {0.0, 1.0, 0.0}, {-s, 0.0, c}}};
}

}  // namespace

cable::CableVector textbook_lengths(const cable::RobotParams& table, const cable::CableLayout& layout,
                                    const cable::ThetaVector& theta_rad) {
  cable::CableVector length_m{};
  for (std::size_t j = 0; j < static_cast<std::size_t>(table.segment_count); ++j) {
    const cable::SegmentParams& passed = table.segment[j];
    const double g = passed.face_offset_m;
    const Matrix3 pitch = about_z(theta_rad[2 * j]), yaw = about_y(theta_rad[2 * j + 1]);
    for (std::int32_t k = 0; k < passed.modules; ++k) {
      const Matrix3 turn = k % 2 == 0 ? product(pitch, yaw) : product(yaw, pitch);
      for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
        const auto anchor = static_cast<std::size_t>(layout.segment[c]);
        if (anchor < j) continue;  // ends before this segment
        const Vec3 before{-g, layout.hole_y_m[c], layout.hole_z_m[c]}, hole{g, before[1], before[2]};
        const Vec3 gap = subtract({dot(turn[0], hole), dot(turn[1], hole), dot(turn[2], hole)}, before);
        length_m[c] += std::sqrt(dot(gap, gap));
        const bool last = k + 1 == passed.modules;
        if (last && anchor == j) continue;  // nothing behind the anchor
        length_m[c] += passed.module_length_m - (g + (last ? table.segment[j + 1].face_offset_m : g));
      }
    }
  }
  return length_m;
}

cable::CableGeometry textbook_cables(const cable::RobotParams& table, const cable::CableLayout& layout,
                                     const cable::ThetaVector& theta_rad) {
  cable::CableGeometry out;
  out.length_m = textbook_lengths(table, layout, theta_rad);
  for (std::size_t k = 0; k < static_cast<std::size_t>(table.theta_count()); ++k) {
    cable::ThetaVector more = theta_rad, less = theta_rad;
    more[k] += kStep_rad;
    less[k] -= kStep_rad;
    const cable::CableVector longer = textbook_lengths(table, layout, more),
                             shorter = textbook_lengths(table, layout, less);
    for (std::size_t c = 0; c < static_cast<std::size_t>(table.cable_count()); ++c) {
      out.jacobian_m_rad[c][k] = (longer[c] - shorter[c]) / (2.0 * kStep_rad);
    }
  }
  return out;
}

}  // namespace liana::bench
