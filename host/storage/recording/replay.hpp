// Runs recorded Inputs through the core again and compares every Outputs field, bit by bit.
#pragma once

#include <cstdint>
#include <string>

namespace liana::recording {

struct ReplayResult {
  std::uint64_t ticks = 0;
  std::uint64_t differing_ticks = 0;
  std::uint64_t first_differing_tick = 0;  // valid when differing_ticks > 0
  std::string first_differing_field;       // e.g. "drive[3].target_counts"
  std::uint64_t missing_ticks = 0;  // recorded ticks that could not be replayed: after a gap, before the next image
  bool is_serial = false;           // the robot has a serial arm
  bool complete = false;            // the file was finished properly; otherwise it was cut short
  bool same_build = false;          // recorded by this build's core; another core may well differ
  std::string recorded_by;          // build id of the core that recorded
};

// Replays `directory`/ticks.mcap; a recording that starts in mid-run, or has a gap, goes on from an image in
// snapshots.mcap. Throws std::runtime_error when there is no recording, some byte of it is not as it was written, or it
// starts in mid-run without an image that this build can use. Nothing of a damaged file reaches the core.
ReplayResult replay(const std::string& directory);

}  // namespace liana::recording
