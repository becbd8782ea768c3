// The least distance along a path of the arm, certain between the poses looked at: a part of the independent check
// (plan_check.hpp).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "firmware_like/cable/arm/robot_params.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

constexpr double kUnseen_m = 0.0002;  // what the least distance found may be above the true one

class PathSearch {
 public:
  // `look` tells the distance at a pose; it changes by at most `pace` times what any point of the arm moves. Distances
  // of `enough_m` and more need not be told apart.
  PathSearch(const RobotParams& table, std::function<double(const ThetaVector&)> look, double pace, double enough_m)
      : table_(table), look_(std::move(look)), pace_(pace), min_m_(enough_m) {}

  // Looks at every waypoint, and at as many poses between them as certainty needs.
  void along(const std::vector<ThetaVector>& path);
  std::int64_t poses() const { return poses_; }

 private:
  // A piece of the path with the distances of its ends.
  struct Piece {
    ThetaVector from, to;
    double from_m, to_m;
  };
  double look(const ThetaVector& theta_rad);
  void search(const Piece& whole);

  const RobotParams& table_;
  std::function<double(const ThetaVector&)> look_;
  double pace_;
  double min_m_;
  std::int64_t poses_ = 0;
};

}  // namespace liana::planner
