// Planned moves between two points: minimum-jerk joint moves, straight tip lines, and the way back along the stored path.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "firmware_like/controller_io.hpp"

namespace liana {

// Share of the limits that planned moves use; the rest is for the filters that follow them.
constexpr double kMoveShare = 0.9;

// Share of the theta acceleration limit that joint moves use. All thetas together swing the whole arm: 1 deg/s2 would take 100 N off a
// cable.
constexpr double kMoveAccelShare = 0.02;

// Minimum-jerk position for time share 0..1 (clamped): 0..1 with velocity and acceleration zero at both ends.
double minimum_jerk(double share);

// All joints together from `from` to `to`.
class JointMove {
 public:
  // Duration such that no theta passes `rate_rad_s` and its acceleration limit, and the tip not its speed limit.
  JointMove(const RobotTable& table, const ThetaVector& from_rad, const ThetaVector& to_rad, double rate_rad_s);
  double duration_s() const { return duration_s_; }
  // Angles at a time since the start.
  ThetaVector at(double time_s) const;

 private:
  ThetaVector from_rad_, to_rad_;
  double duration_s_ = 0.0;
};

// The tip along a straight line, turning about one axis.
class TipLine {
 public:
  TipLine(const RobotTable& table, const Pose& from, const Pose& to, double speed_m_s);
  double duration_s() const { return duration_s_; }
  Pose at(double time_s) const;

 private:
  Pose from_, to_;
  Vec3 turn_rad_{};
  double duration_s_ = 0.0;
};

// What the arm was commanded after verification, one point per command interval in which it moved.
class PathMemory {
 public:
  // Notes where the command stands at `tick`; points closer than 1e-7 rad to the last one are left out.
  void note(std::uint64_t tick, const ThetaVector& theta_rad);
  void clear() { points_.clear(); }
  bool empty() const { return points_.empty(); }
  // Takes the newest point off; nothing when it is older than `until_tick` or none is left.
  std::optional<ThetaVector> step_back(std::uint64_t until_tick);

 private:
  struct Point {
    std::uint64_t tick;
    ThetaVector theta_rad;
  };
  std::deque<Point> points_;
};

}  // namespace liana
