// lab_1g as a seed builds it, in one of its mountings: its load measured as `liana calibrate --load` does, and how it
// then stands.
#pragma once

#include <cstdint>
#include <vector>

#include "fixture.hpp"
#include "host/drives/calibration/load_fit.hpp"
#include "host/drives/calibration/load_poses.hpp"
#include "host/drives/calibration/tracker_fit.hpp"

namespace liana::closed_loop {

// The load found in these poses by an arm of this seed that believes its table.
calibration::LoadResult find_load(const LabMounting& mounting, std::uint64_t seed,
                                  const std::vector<calibration::LoadPose>& poses);

// Geometry and zeros found in these poses, by a tracker as `liana calibrate --tracker` does; of an arm whose lengths
// and hole radius differ by `geometry_share` at most.
calibration::TrackerResult find_geometry(const LabMounting& mounting, std::uint64_t seed, double geometry_share,
                                         const std::vector<calibration::LoadPose>& poses);

// How an arm of this seed stands in poses that it comes to with this table, from both sides; its geometry off, and its
// drives' zeros put right.
struct Standing {
  std::vector<double> tip_error_m;      // against the commanded pose, by pose and side
  std::vector<double> tension_error_N;  // rms over cables, measured less planned, by pose: mean of both sides
  std::vector<double> load_error_Nm;    // rms over angles, of torque that the load does not explain, the same
};
Standing standing(const LabMounting& mounting, std::uint64_t seed, const cable::RobotParams& table,
                  const std::vector<calibration::LoadPose>& poses, double geometry_share = 0.0,
                  const cable::CableVector& zero_m = {});

// The table with what was found.
cable::RobotParams with(const cable::RobotParams& table, const calibration::FieldsFound& found);

// Drawn poses within 0.8 of the limits.
std::vector<calibration::LoadPose> drawn_poses(const cable::RobotParams& table, std::uint64_t seed, std::size_t count);

}  // namespace liana::closed_loop
