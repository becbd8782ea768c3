#include "host/control/clearance_bound/length_errors.hpp"

namespace liana::clearance_bound {

AnglesOfLengths angles_of_lengths(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad) {
  const CableGeometry geometry = cable_geometry(table, layout, arm_trig(table, theta_rad));
  CableSolver solver;
  update_cable_solver(table, geometry, solver);
  AnglesOfLengths angles{};
  CableVector one{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(layout.cable_count); ++c) {
    one[c] = 1.0;
    angles[c] = solve_cables(table, geometry, solver, one).theta_rad;
    one[c] = 0.0;
  }
  return angles;
}

// Tension falls by mu times the bend passed, to first order: by half of its own segment's in the middle of that.
CableVector lengths_of_friction(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad,
                                double mu, double tension_N) {
  const ArmTrig trig = arm_trig(table, theta_rad);
  const CableGeometry geometry = cable_geometry(table, layout, trig);
  const SegmentVector wraps_rad = cable_wraps(table, trig);
  CableVector length_m{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(layout.cable_count); ++c) {
    double passed_rad = 0.0;
    for (std::size_t m = 0; m <= static_cast<std::size_t>(layout.segment[c]); ++m) {
      length_m[c] += geometry.part_m[c][m] * (passed_rad + 0.5 * wraps_rad[m]) * mu * tension_N / table.cable_EA_N;
      passed_rad += wraps_rad[m];
    }
  }
  return length_m;
}

ThetaVector changed(const AnglesOfLengths& angles, const ThetaVector& theta_rad, const CableVector& length_m,
                    std::int32_t cables) {
  ThetaVector out = theta_rad;
  for (std::size_t c = 0; c < static_cast<std::size_t>(cables); ++c) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += angles[c][i] * length_m[c];
  }
  return out;
}

}  // namespace liana::clearance_bound
