// Cable map: joint angles to cable path lengths and back (mission, A3).
//
// Cable c of segment m is anchored at the last disc of segment m and passes every disc of segments 1..m. Odd (Rz Ry)
// and even (Ry Rz) joints give the same hole-to-hole distance d, so the path is sum over segments j <= m of modules_j
// d_j(c) plus the straight parts:
//   d^2 = 2 (g^2 + r^2) - 2 [-g^2 ca cb + g y sa (1 + cb) - g z sb (1 + ca) + y^2 ca + y z sa sb + z^2 cb],  y = r cos
//   phase, z = r sin phase, r of segment m, g of segment j.
// A base that feeds carries the drums: it changes none of these paths, and its own two drives have its slide's way and
// its belt's as theirs, zero at the lower limit.
#pragma once

#include <array>
#include <cstdint>

#include "firmware_like/cable/arm/kinematics.hpp"
#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::cable {

// Path of each cable within each segment [m].
using CableParts = std::array<std::array<double, kMaxSegments>, kMaxCables>;

// Geometry of all cables at one pose. Row c is a cable, [m] a segment it passes; entries beyond its own segment are
// zero.
struct CableGeometry {
  CableVector length_m{};                                                  // path from the first disc to the anchor
  CableParts part_m{};                                                     // path within one segment
  std::array<std::array<double, kMaxTheta>, kMaxCables> jacobian_m_rad{};  // d length / d theta
};

// Hole positions and straight parts, computed once from the table.
struct CableLayout {
  std::int32_t cable_count = 0;
  std::array<std::int32_t, kMaxCables> segment{};  // 0-based segment a cable is anchored in
  CableVector hole_y_m{}, hole_z_m{};
  std::array<std::array<double, kMaxSegments>, kMaxCables> straight_m{};  // parts of the path inside links
  CableVector zero_length_m{};                                            // path at the zero pose
};

// Layout of a table; phases may be anything.
CableLayout cable_layout(const RobotParams& table) noexcept;

// Lengths, parts and Jacobian at one pose. `out` must have been zero or a geometry of the same table: entries beyond a
// cable's own segment are not written. Cost: one square root per cable and segment passed (45 for five segments of
// three cables).
void update_cable_geometry(const RobotParams& table, const CableLayout& layout, const ArmTrig& trig,
                           CableGeometry& out) noexcept;
CableGeometry cable_geometry(const RobotParams& table, const CableLayout& layout, const ArmTrig& trig) noexcept;

// Two angles from three lengths, segment by segment from the base: each segment's angles are the least squares of its
// own cables, whose paths are first freed from what the segments before them do. What is left over is each segment's
// own contradiction.
struct CableSolver {
  struct Segment {
    double pp = 0.0, pq = 0.0, qq = 0.0,
           inverse_det = 0.0;  // 2 x 2 normal matrix; inverse_det 0 = these cables cannot turn both angles
  };
  std::array<Segment, kMaxSegments> segment{};
};
void update_cable_solver(const RobotParams& table, const CableGeometry& geometry, CableSolver& solver) noexcept;

// Angles by which a change of cable paths moves the arm, with the geometry that `solver` belongs to; zero where a
// segment is singular. Cost: one multiplication per entry of the Jacobian.
struct CableSolution {
  ThetaVector theta_rad{};
  CableVector left_m{};  // of the change, not explained by any angles: cables of a segment that contradict each other
};
CableSolution solve_cables(const RobotParams& table, const CableGeometry& geometry, const CableSolver& solver,
                           const CableVector& change_m) noexcept;

// Bend [rad] of a cable along each whole segment, the same for all cables.
using SegmentVector = std::array<double, kMaxSegments>;
SegmentVector cable_wraps(const RobotParams& table, const ArmTrig& trig) noexcept;

}  // namespace liana::cable
