// From what the drives report at known poses to zeros, drums and directions, and to what is wired wrong
// (docs/how-to/calibrate.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "host/drives/calibration/calibration.hpp"

namespace liana::calibration {

// The arm in a fixture at a known pose: what every drive reports, by the robot table.
struct CalibrationReading {
  cable::ThetaVector theta_rad{};
  cable::CableVector position_m{};  // paid out beyond the table's zero
  cable::CableVector tension_N{};
  std::array<std::uint32_t, cable::kMaxCables> serial{};  // 0x1018:4
};

struct CalibrationResult {
  Calibration calibration;            // complete only without problems
  std::vector<std::string> problems;  // each names drive or cable, what was found and what to do
};

// The poses tell every two cables apart, by 4 % of the hole radius, and every cable changes enough to see its
// direction; throws std::runtime_error naming what is missing. At least two poses.
void check_poses(const config::RobotConfig& robot, std::span<const cable::ThetaVector> poses_rad);

// By which the length of every cable of `segment` (0-based) has to differ from its mean over the poses, for its
// direction to be seen: as much as 0.16 rad make at the segment's holes. A base goes by the segment beyond it.
double min_change_m(const cable::RobotParams& robot, std::size_t segment);

// Fits a drum radius and a zero to every drive. A drive that counts backwards gets the other direction and is a problem
// of nobody; cables that are wound on each other's drums, a drum that is off by over 2 %, readings that no drum
// explains, and a drive without a serial number of its own are problems.
CalibrationResult calibrate(const config::RobotConfig& robot, std::span<const CalibrationReading> readings,
                            const std::string& date);

}  // namespace liana::calibration
