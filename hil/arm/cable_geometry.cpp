#include "hil/arm/cable_geometry.hpp"

#include <algorithm>
#include <cmath>

namespace liana::bench {

namespace {

double angle_of(double cosine) { return std::acos(std::clamp(cosine, -1.0, 1.0)); }

}  // namespace

Bend Bend::of(double pitch_rad, double yaw_rad) {
  return {std::cos(pitch_rad), std::sin(pitch_rad), std::cos(yaw_rad), std::sin(yaw_rad)};
}

HoleGap hole_gap(const Bend& bend, double y_m, double z_m, double face_m) {
  // Proximal frame, R = Rz(pitch) Ry(yaw): the near hole is b = (-f, y, z), the far one R a with a = (f, y, z).
  const double qx = bend.cos_yaw * face_m + bend.sin_yaw * z_m;
  const double qz = -bend.sin_yaw * face_m + bend.cos_yaw * z_m;
  const double far_x = bend.cos_pitch * qx - bend.sin_pitch * y_m;
  const double far_y = bend.sin_pitch * qx + bend.cos_pitch * y_m;
  const double vx = far_x + face_m;
  const double vy = far_y - y_m;
  const double vz = qz - z_m;
  HoleGap gap;
  gap.distance_m = std::sqrt(vx * vx + vy * vy + vz * vz);
  // d distance = v . d(R a) / distance
  const double inverse = 1.0 / gap.distance_m;
  gap.d_pitch_m = inverse * (-vx * far_y + vy * far_x);
  gap.d_yaw_m = inverse * (qz * (vx * bend.cos_pitch + vy * bend.sin_pitch) - vz * qx);
  // Directions of the links: x before the joint, R x after it.
  const double after = bend.cos_yaw * (bend.cos_pitch * vx + bend.sin_pitch * vy) - bend.sin_yaw * vz;
  gap.wrap_rad = angle_of(inverse * vx) + angle_of(inverse * after);
  return gap;
}

CablePaths::CablePaths(const RobotConfig& robot, double hole_radius_error_m, const Linkage& linkage) : robot_(robot) {
  std::size_t module = 0;
  for (std::size_t m = 0; m < robot.segments.size(); ++m) {
    const SegmentConfig& segment = robot.segments[m];
    const double radius_m = segment.hole_radius_m + hole_radius_error_m;
    for (const double phase : segment.cable_phase_rad)
      cables_.push_back({m, radius_m * std::cos(phase), radius_m * std::sin(phase)});
    if (segment.modules == 0) continue;  // a base
    if (linkage.empty()) joints_.push_back({m, static_cast<double>(segment.modules), {}});
    for (int i = 0; !linkage.empty() && i < segment.modules; ++i) joints_.push_back({m, 1.0, linkage[module++]});
  }
  paths_.resize(cables_.size());
  bends_.resize(joints_.size());
  update(Theta{});
}

void CablePaths::update(const Theta& theta_rad) {
  for (std::size_t i = 0; i < joints_.size(); ++i) {
    const auto& [segment, count, share] = joints_[i];
    bends_[i] = Bend::of(share.pitch * theta_rad[2 * segment], share.yaw * theta_rad[2 * segment + 1]);
  }
  for (std::size_t c = 0; c < cables_.size(); ++c) {
    const Cable& cable = cables_[c];
    paths_[c] = {};
    for (std::size_t i = 0; i < joints_.size() && joints_[i].segment <= cable.segment; ++i) {
      const auto& [segment, count, share] = joints_[i];
      const HoleGap gap = hole_gap(bends_[i], cable.hole_y_m, cable.hole_z_m, robot_.segments[segment].face_offset_m);
      SegmentPath& path = paths_[c][segment];
      path.length_m += count * gap.distance_m;
      path.d_pitch_m += count * share.pitch * gap.d_pitch_m;
      path.d_yaw_m += count * share.yaw * gap.d_yaw_m;
      path.wrap_rad += count * gap.wrap_rad;
    }
    for (std::size_t j = first_segment(); j <= cable.segment; ++j) {
      const SegmentConfig& segment = robot_.segments[j];
      const double links = segment.modules - (j == cable.segment ? 1 : 0);  // anchored right after the last joint
      paths_[c][j].length_m += links * (segment.module_length_m - 2.0 * segment.face_offset_m);
      // The last link that the cable passes ends with the next segment's disc.
      if (j < cable.segment) paths_[c][j].length_m += segment.face_offset_m - robot_.segments[j + 1].face_offset_m;
    }
  }
}

double CablePaths::length_m(std::size_t cable) const {
  double length = 0.0;
  for (std::size_t j = 0; j <= cables_[cable].segment; ++j) length += paths_[cable][j].length_m;
  return length;
}

CableJacobian CablePaths::jacobian() const {
  CableJacobian jacobian{};
  for (std::size_t c = 0; c < cables_.size(); ++c) {
    for (std::size_t j = 0; j <= cables_[c].segment; ++j) {
      jacobian[c][2 * j] = paths_[c][j].d_pitch_m;
      jacobian[c][2 * j + 1] = paths_[c][j].d_yaw_m;
    }
  }
  return jacobian;
}

}  // namespace liana::bench
