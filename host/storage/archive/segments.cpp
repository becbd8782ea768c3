#include "host/storage/archive/segments.hpp"

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <tuple>

namespace liana::archive {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> kParts{"", "-wal", "-shm", "-journal"};

}  // namespace

std::string segment_path(const std::string& folder, std::uint64_t life, std::uint64_t first_tick) {
  char name[80];
  std::snprintf(name, sizeof name, "/telemetry-%" PRIu64 "-%012" PRIu64 ".db", life, first_tick);
  return folder + name;
}

std::vector<Segment> segments_in(const std::string& folder) {
  std::vector<Segment> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, none)) {
    Segment segment{0, 0, entry.path()};
    const std::string name = entry.path().filename();
    const bool is_one =
        std::sscanf(name.c_str(), "telemetry-%" SCNu64 "-%" SCNu64 ".db", &segment.life, &segment.first_tick) == 2 &&
        segment_path(folder, segment.life, segment.first_tick).ends_with("/" + name);
    if (is_one) found.push_back(segment);
  }
  std::sort(found.begin(), found.end(), [](const Segment& a, const Segment& b) {
    return std::tie(a.life, a.first_tick) < std::tie(b.life, b.first_tick);
  });
  return found;
}

std::uint64_t bytes_of(const std::vector<Segment>& segments) {
  std::uint64_t sum = 0;
  for (const Segment& segment : segments) {
    for (const char* part : kParts) {
      std::error_code none;
      const std::uintmax_t bytes = fs::file_size(segment.path + part, none);
      if (!none) sum += bytes;
    }
  }
  return sum;
}

bool remove_segment(const Segment& segment) {
  bool is_gone = true;
  for (const char* part : kParts) {
    std::error_code failed;
    fs::remove(segment.path + part, failed);
    is_gone = is_gone && !failed;
  }
  return is_gone;
}

}  // namespace liana::archive
