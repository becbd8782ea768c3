// A way of moving: back along the path that was commanded. First nothing is asked for until the arm has come to rest; a
// refusal ends in rest, too, and the next start takes the place that was refused slowly.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "host/arbiter/arm_kind.hpp"
#include "host/arbiter/path_memory.hpp"

namespace liana::arbiter {

// Path points per command interval on the way back: slower than the way in, so that what passed verification then
// passes it again.
constexpr double kWayBackPace = 0.8;

template <class Arm>
class WayBack {
 public:
  static constexpr bool kIsPlanned = true;

  // Back to where the command stood at `until_tick`. `path` has to outlive this; points are taken off it.
  WayBack(PathMemory<Joints<Arm>>& path, std::uint64_t until_tick) : path_(path), until_tick_(until_tick) {}

  // At rest: from now on the path is not to be noted. The stop before belongs to the way in.
  bool has_begun() const { return rest_intervals_ >= kRestIntervals; }

  Goal<Arm> next(const liana::Outputs<Arm>& now) {
    if (!has_begun()) {
      rest_intervals_ = now.at_rest != 0 ? rest_intervals_ + 1 : 0;
      return {};
    }
    const std::optional<Joints<Arm>> joint_rad = step();
    is_over_ = !joint_rad;
    return joint_rad ? Goal<Arm>(*joint_rad) : Goal<Arm>();
  }
  // All the way has been gone.
  bool is_over() const { return is_over_; }
  // Starts again from rest, at the newest point of the path; false when that was refused too often.
  bool refused() {
    rest_intervals_ = 0;
    pace_ = 0.0;
    to_rad_ = std::nullopt;
    at_end_ = false;
    return ++starts_ < kMostStarts;
  }

 private:
  static constexpr std::int32_t kRestIntervals = 3;  // a command released before the stop may still be on its way
  static constexpr double kPaceGain = 0.008;         // per command interval: full pace after 2 s
  static constexpr int kMostStarts = 10;

  // One command interval on; nothing at the end.
  std::optional<Joints<Arm>> step() {
    if (!to_rad_) {  // at rest: the newest point is where the command stands
      to_rad_ = path_.step_back(until_tick_);
      if (!to_rad_ || at_end_) return std::nullopt;
      share_ = 1.0;
    }
    pace_ = std::min(kWayBackPace, pace_ + kPaceGain);
    share_ += pace_;
    if (share_ >= 1.0) {
      share_ -= 1.0;
      from_rad_ = *to_rad_;
      to_rad_ = path_.step_back(until_tick_);
      at_end_ = !to_rad_;
    }
    return at_end_ ? from_rad_ : between(from_rad_, *to_rad_, share_);
  }

  PathMemory<Joints<Arm>>& path_;
  std::uint64_t until_tick_;
  std::int32_t rest_intervals_ = 0;  // in a row
  int starts_ = 0;
  bool at_end_ = false, is_over_ = false;
  double pace_ = 0.0;   // points per interval now
  double share_ = 0.0;  // of the way from the point reached last to the next one
  Joints<Arm> from_rad_{};
  std::optional<Joints<Arm>> to_rad_;
};

}  // namespace liana::arbiter
