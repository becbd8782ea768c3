#include "host/planning/planner/check/path_search.hpp"

#include <algorithm>
#include <cmath>

namespace liana::planner {
namespace {

using Index = std::size_t;

// No point of the arm moves more than this while the thetas change by `b - a`: every joint of a segment turns by the
// change, with at most the length of the arm from the segment's root as lever.
double largest_motion_m(const RobotParams& table, const ThetaVector& a, const ThetaVector& b) {
  double lever_m = 0.0, motion_m = 0.0;
  for (Index m = static_cast<Index>(table.segment_count); m-- > 0;) {
    if (const SegmentParams& base = table.segment[m]; feeds(base))
      motion_m += base.slide_m_rad * std::fabs(b[0] - a[0]) + lever_m * std::fabs(b[1] - a[1]);
    lever_m += table.segment[m].modules * table.segment[m].module_length_m;
    const double turn = std::fabs(b[2 * m] - a[2 * m]) + std::fabs(b[2 * m + 1] - a[2 * m + 1]);
    motion_m += table.segment[m].modules * turn * lever_m;
  }
  return motion_m;
}

}  // namespace

void PathSearch::along(const std::vector<ThetaVector>& path) {
  std::vector<double> at_waypoint_m;
  for (const ThetaVector& theta : path) at_waypoint_m.push_back(look(theta));
  for (Index w = 0; w + 1 < path.size(); ++w) search({path[w], path[w + 1], at_waypoint_m[w], at_waypoint_m[w + 1]});
}

double PathSearch::look(const ThetaVector& theta_rad) {
  ++poses_;
  const double here_m = look_(theta_rad);
  min_m_ = std::min(min_m_, here_m);
  return here_m;
}

// Halves the piece until nothing below the least - kUnseen_m can be hidden in it. From an end with distance c the arm
// has to move (c - d) / pace to come as near as d, so within a piece d >= (sum of both distances - pace motion) / 2.
void PathSearch::search(const Piece& whole) {
  std::vector<Piece> open{whole};
  while (!open.empty()) {
    const Piece piece = open.back();
    open.pop_back();
    const double motion_m = pace_ * largest_motion_m(table_, piece.from, piece.to);
    if ((piece.from_m + piece.to_m - motion_m) / 2.0 >= min_m_ - kUnseen_m) continue;
    ThetaVector middle{};
    for (Index k = 0; k < middle.size(); ++k) middle[k] = 0.5 * (piece.from[k] + piece.to[k]);
    const double middle_m = look(middle);
    open.push_back({middle, piece.to, middle_m, piece.to_m});
    open.push_back({piece.from, middle, piece.from_m, middle_m});
  }
}

}  // namespace liana::planner
