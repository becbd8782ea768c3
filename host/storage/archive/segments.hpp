// Files of telemetry beside archive.db: telemetry-LIFE-FIRSTTICK.db, each of an hour or less.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace liana::archive {

struct Segment {
  std::uint64_t life = 0;
  std::uint64_t first_tick = 0;
  std::string path;
};

// Where the file that begins at this tick is.
std::string segment_path(const std::string& folder, std::uint64_t life, std::uint64_t first_tick);

// Those of a folder, oldest first; none where there is no such folder.
std::vector<Segment> segments_in(const std::string& folder);

// Of all of them, with what SQLite keeps beside them.
std::uint64_t bytes_of(const std::vector<Segment>& segments);

// Takes the file away, with what SQLite keeps beside it; false: something of it is still there.
bool remove_segment(const Segment& segment);

}  // namespace liana::archive
