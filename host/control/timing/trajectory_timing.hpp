// How planned motion spends its time, from rest to rest: minimum jerk, or a law after which a base that swings is
// still.
#pragma once

#include <array>
#include <cstddef>

#include "firmware_like/operator_input/tip_filter.hpp"

namespace liana::motion {

// Share of the limits that planned moves use; the rest is for the filters that follow them.
constexpr double kMoveShare = 0.9;
FilterBounds share_of(const FilterBounds& bounds);

// Periods with which the arm's base swings; 0: it does not.
struct Swings {
  double slow_s = 0.0;
  double quick_s = 0.0;
  double off = 0.1;  // share by which slow_s may differ from the true period, at most 0.2
};

// What a move needs of its law for a way of 1: its longest way per speed, per acceleration and per jerk.
struct MoveNeeds {
  double speed_s = 0.0;
  double accel_s2 = 0.0;
  double jerk_s3 = 0.0;

  void add(double way, const FilterBounds& bounds);
};

// Share of the way over time: the shortest minimum-jerk motion that keeps the limits, where nothing swings. Else the
// velocity is a pulse averaged about the slow period and once over the quick one. An average over a swing's own period
// leaves nothing of it (a zero of the spectrum: input shaping); two about it, 6 % below and above, leave less than 1 %
// of the way to any that is up to a tenth off; three, over 0.85, 1 and 1.18 of it, to any that is up to a fifth off.
// That takes the sum of those times at least, however short the way.
class TrajectoryTiming {
 public:
  TrajectoryTiming() = default;
  TrajectoryTiming(const MoveNeeds& needs, const Swings& swings);

  double duration_s() const { return duration_s_; }
  // 0..1; clamped outside 0..duration_s().
  double share_at(double time_s) const;

 private:
  void add_average(double length_s);

  static constexpr std::size_t kAverages = 5;

  std::array<double, kAverages> average_s_{};  // those with a length, first
  std::size_t averages_ = 0;                   // 0: minimum jerk
  double duration_s_ = 0.0;
};

}  // namespace liana::motion
