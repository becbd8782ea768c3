// How drives and cables are written in every message, table and file: counted from 1, with node and segment.
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "host/model/config/config.hpp"

namespace liana::config {

// "drive 4 (node 4, segment 2)", "drive 4 (node 2, axis 2)"; `drive`: 0-based; `segment`: from 1, 0 where there is
// none.
std::string drive_text(std::size_t drive, DrivePlace place, int segment = 0);

// Names of the drives and cables of one arm, whose indices are 0-based.
class DriveNames {
 public:
  // Of an arm without cables. Where no place is known, each drive is a node.
  explicit DriveNames(std::vector<DrivePlace> places = {}) : places_(std::move(places)) {}
  explicit DriveNames(const cable::RobotParams& table, std::vector<DrivePlace> places = {});
  explicit DriveNames(const RobotConfig& robot) : DriveNames(robot.table, robot.drive_places) {}

  std::string drive(std::size_t drive) const { return drive_text(drive, place_of(drive), segment_of(drive)); }
  DrivePlace place_of(std::size_t drive) const {
    return drive < places_.size() ? places_[drive] : DrivePlace(static_cast<std::int32_t>(drive) + 1);
  }
  // "cable 4 (segment 2)"; "slide" or "roll" of a base that feeds
  std::string cable(std::size_t cable) const;
  // From 1; 0 where there is none.
  int segment_of(std::size_t drive) const { return drive < segments_.size() ? segments_[drive] : 0; }

 private:
  std::vector<DrivePlace> places_;
  std::vector<int> segments_;
  std::size_t feed_count_ = 0;
};

}  // namespace liana::config
