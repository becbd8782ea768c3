// Points of the verified way back, whatever the arm: what a copy on disk is made of.
#pragma once

#include <cstdint>
#include <vector>

namespace liana::arbiter {

struct WayPoint {
  bool begins = false;  // the arm was enabled here: from the point before it no command led here
  std::vector<double> joint_rad;
  bool operator==(const WayPoint&) const = default;
};

// What has changed. Points have numbers that only grow: `first` is that of the oldest, those from `kept` on are gone,
// and `added` follow it.
struct WayChange {
  std::uint64_t first = 0;
  std::uint64_t kept = 0;
  std::vector<WayPoint> added;
};

// All there is; `first` is the number of the oldest.
struct KeptWay {
  std::uint64_t first = 0;
  std::vector<WayPoint> points;
};

}  // namespace liana::arbiter
