// How long each cable is for given joint angles: straight between the holes of a universal joint, straight inside a
// link (mission, A3).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "hil/arm/linkage.hpp"
#include "hil/config/robot_config.hpp"
#include "hil/math/reduced.hpp"

namespace liana::bench {

// Cosine and sine of the pitch and yaw that bend a joint.
struct Bend {
  double cos_pitch = 1.0;
  double sin_pitch = 0.0;
  double cos_yaw = 1.0;
  double sin_yaw = 0.0;
  static Bend of(double pitch_rad, double yaw_rad);
};

// One cable across one universal joint. Both axis orders (pitch first, yaw first) give the same values, by reflection
// in the disc plane.
struct HoleGap {
  double distance_m = 0.0;
  double d_pitch_m = 0.0;  // d distance / d pitch [m/rad]
  double d_yaw_m = 0.0;
  double wrap_rad = 0.0;  // summed change of direction at the two holes
};

// Closed form; `y_m`, `z_m` is the hole on the disc, `face_m` the distance of each disc from the joint centre (> 0).
HoleGap hole_gap(const Bend& bend, double y_m, double z_m, double face_m);

// One cable inside one segment: all its joints and links together.
struct SegmentPath {
  double length_m = 0.0;
  double d_pitch_m = 0.0;
  double d_yaw_m = 0.0;
  double wrap_rad = 0.0;
};

// All cables through all segments, recomputed by update().
class CablePaths {
 public:
  // All holes are `hole_radius_error_m` farther from the axis than the table says; `linkage` is the true one.
  explicit CablePaths(const RobotConfig& robot, double hole_radius_error_m = 0.0, const Linkage& linkage = {});

  void update(const Theta& theta_rad);

  std::size_t cable_count() const { return cables_.size(); }
  // First segment that cables run through (0-based): they start on the carriage of a base, so it changes no length.
  std::size_t first_segment() const { return robot_.first_bending(); }
  // Last segment the cable runs through (0-based); it is anchored at the end of it.
  std::size_t last_segment(std::size_t cable) const { return cables_[cable].segment; }
  const SegmentPath& path(std::size_t cable, std::size_t segment) const { return paths_[cable][segment]; }
  // From the first disc to the anchor [m].
  double length_m(std::size_t cable) const;
  // d length / d theta of every cable [m/rad].
  CableJacobian jacobian() const;

 private:
  struct Cable {
    std::size_t segment;
    double hole_y_m;
    double hole_z_m;
  };
  // Joints of a segment that bend alike: all of them, or one where the linkage is uneven.
  struct Joints {
    std::size_t segment;
    double count;
    BendShare share;
  };
  const RobotConfig robot_;
  std::vector<Joints> joints_;  // from the base
  std::vector<Bend> bends_;     // of each of them now
  std::vector<Cable> cables_;
  std::vector<std::array<SegmentPath, kMaxSegments>> paths_;
};

}  // namespace liana::bench
