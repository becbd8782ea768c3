// What an external tracker says of an arm: module lengths, hole radius, stiffness, from the poses of a marker at its
// tip and the drives' lengths and tensions at rest (docs/how-to/calibrate.md).
//
// Least squares. Every pose has its own angles, which all readings of it share: lengths of the cables, pose of the
// marker, and the balance of torques (load_model.hpp) of an arm with weight or springs. They are eliminated pose by
// pose. Found beside them, and not kept: where tracker and marker are, the rest of the load, and torque gains.
//
// Sources: calibration of a robot from poses of its tip, Hollerbach and Wampler 1996 (doi
// 10.1177/027836499601500604); where tracker and marker are to begin with, Shah 2013 (doi 10.1115/1.4024473);
// elimination of some unknowns, Golub and Pereyra 1973 (doi 10.1137/0710036).
#pragma once

#include <vector>

#include "firmware_like/math/pose.hpp"
#include "host/drives/calibration/prior_fit.hpp"

namespace liana::calibration {

constexpr std::size_t kMinTrackerPoses = 8;
constexpr double kTrackerNoise_m = 0.1e-3;      // of a pose that was averaged; what optical trackers are sold for
constexpr double kTrackerNoise_rad = 8.727e-4;  // 0.05 deg
constexpr double kPriorZero_m = 0.3e-3;         // of a cable, by jigs

// The arm at rest: what its drives report by the calibration in use, its mean tensions at the motors, and what the
// tracker saw.
struct StillPose {
  cable::ThetaVector theta_rad{};   // measured
  cable::CableVector position_m{};  // paid out beyond each zero
  cable::CableVector tension_N{};
  Pose marker_in_tracker{};
};

// Root mean squares over poses, of where the cables say that the marker is.
struct TrackerError {
  double tip_m = 0.0;
  double tip_rad = 0.0;
};

// Of geometry and joint stiffness.
struct TrackerResult : FieldsFound {
  cable::CableVector zero_m{};  // that each cable is longer than its drive says
  TrackerError before, after;
};

// `table`: as designed; `known`: what the arm's calibration says of its load. Throws std::runtime_error with fewer than
// kMinTrackerPoses poses, or when they turn the tip about one axis only.
TrackerResult tracker_fit(const cable::RobotParams& table, const std::vector<FieldValue>& known,
                          const std::vector<StillPose>& poses);

}  // namespace liana::calibration
