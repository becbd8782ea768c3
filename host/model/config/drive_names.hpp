// How drives and cables are written in every message, table and file: counted from 1, with node and segment.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::config {

// "drive 4 (node 4, segment 2)"; `drive`: 0-based; `segment`: from 1, 0 where there is none.
std::string drive_text(std::size_t drive, int segment = 0);

// Names of the drives and cables of one arm, whose indices are 0-based.
class DriveNames {
 public:
  DriveNames() = default;  // of an arm without cables
  explicit DriveNames(const cable::RobotParams& table);

  std::string drive(std::size_t drive) const { return drive_text(drive, segment_of(drive)); }
  // "cable 4 (segment 2)"; "slide" or "roll" of a base that feeds
  std::string cable(std::size_t cable) const;
  // From 1; 0 where there is none.
  int segment_of(std::size_t drive) const { return drive < segments_.size() ? segments_[drive] : 0; }

 private:
  std::vector<int> segments_;
  std::size_t feed_count_ = 0;
};

}  // namespace liana::config
