// Where the arm of a run stood still, from its archive.
#pragma once

#include <string>
#include <vector>

#include "host/drives/calibration/tracker_fit.hpp"
#include "host/drives/calibration/tracker_track.hpp"
#include "host/model/config/config.hpp"

namespace liana::cli {

// One stay, after the arm has settled: what its drives said in the mean. No marker yet.
struct Stay {
  double from_s = 0.0, to_s = 0.0;
  calibration::StillPose pose;
};

struct Stays {
  std::vector<calibration::TimedPoint> tip;  // by the arm's own measurement, in the base frame
  std::vector<Stay> stays;
};

// `folder`: of a run's archive. Throws std::runtime_error when it cannot be read, or is of another robot or table.
Stays stays_of(const std::string& folder, const config::RobotConfig& robot);

// Every stay during which the marker stands, too. Throws std::runtime_error when the marker does not move as the tip,
// or there are fewer than calibration::kMinTrackerPoses.
std::vector<calibration::StillPose> still_poses(const Stays& run, const std::vector<calibration::TrackedPose>& tracked);

}  // namespace liana::cli
