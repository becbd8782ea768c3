// What the images of a recording are worth: replay itself reads them only where the recording has a gap.
#pragma once

#include <cstdint>
#include <string>

namespace liana::recording {

struct ImagesCheck {
  std::string state = "missing";  // or whole, cut short, damaged
  std::uint64_t count = 0;        // images that can be read; of a whole file only
  bool good() const { return state == "missing" || state == "whole"; }
};

// Reads all of `directory`/snapshots.mcap; `is_serial`: the robot has a serial arm (ReplayResult).
ImagesCheck check_images(const std::string& directory, bool is_serial);

}  // namespace liana::recording
