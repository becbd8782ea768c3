// Poses of a marker as an external tracker wrote them, and how its clock goes beside the run's
// (docs/reference/formats.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "firmware_like/math/pose.hpp"

namespace liana::calibration {

constexpr std::size_t kMaxTrackerRows = 2000000;
constexpr double kMaxTrack_s = 7200.0;  // from its first to its last row

struct TrackedPose {
  double time_s = 0.0;
  Pose marker_in_tracker{};
};

// Reads a CSV file. Throws std::runtime_error "file: line 7: qw: value: allowed ...: what to do" for a column that is
// missing or twice, a value that is no finite number or out of range, a quaternion that is not of unit length, times
// that do not rise, and too many rows.
std::vector<TrackedPose> read_tracker(const std::string& path);

// Where a point was, at a time; times rise.
struct TimedPoint {
  double time_s = 0.0;
  Vec3 position_m{};
};

// What to add to times of `tracked` for those of `tip`: both ways have the same speeds then, whatever their frames.
// Throws std::runtime_error when no time makes them alike.
double clock_offset_s(const std::vector<TimedPoint>& tip, const std::vector<TrackedPose>& tracked);

// The mean pose between two times of the tracker's clock; nothing where it has fewer than kMinSamples there, or moves.
constexpr std::size_t kMinSamples = 5;
constexpr double kMinTrackerRate_hz = 5.0;  // gives them in a stay of 1.5 s, less what the clocks' offset is off by
std::optional<Pose> mean_pose(const std::vector<TrackedPose>& tracked, double from_s, double to_s);

}  // namespace liana::calibration
