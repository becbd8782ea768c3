// Planned moves between two points: minimum-jerk joint moves, straight tip lines, and the way back along the stored
// path.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "firmware_like/controller_io.hpp"

namespace liana {

// Share of the limits that planned moves use; the rest is for the filters that follow them.
constexpr double kMoveShare = 0.9;

// Share of the theta acceleration limit that joint moves use. All thetas together swing the whole arm: 1 deg/s2 would
// take 100 N off a cable.
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

// Path points per command interval on the way back: slower than the way in, so that what passed verification then
// passes it again.
constexpr double kWayBackPace = 0.8;

// The way back along a path memory, from rest. A refusal ends in rest, too; the next start takes the place that was
// refused slowly.
class WayBack {
 public:
  // Back to where the command stood at `until_tick`.
  explicit WayBack(std::uint64_t until_tick) : until_tick_(until_tick) {}
  // One command interval on: the angles to command next; nothing at the end.
  std::optional<ThetaVector> next(PathMemory& path);
  // Starts again from rest, at the newest point of the path; false when that was refused too often.
  bool start_again();

 private:
  std::uint64_t until_tick_;
  int starts_ = 0;
  bool ended_ = false;
  double pace_ = 0.0;   // points per interval now
  double share_ = 0.0;  // of the way from the point reached last to the next one
  ThetaVector from_rad_{};
  std::optional<ThetaVector> to_rad_;
};

}  // namespace liana
