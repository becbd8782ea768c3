// Which constraints a problem holds: those that a path is near to.
//
// Spheres are kept off by distance, at the link's point that is nearest on the given path. Boxes and convex
// bodies are kept off by planes: the one that touches the body at its nearest point to the link, with both ends of the
// link before it. Distance to a box has kinks at every edge, and a thin plate can be stepped over; planes have neither,
// and the path they are made from is always on their right side.
#pragma once

#include <vector>

#include "host/planning/planner/problem/plan_problem.hpp"
#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

// A link that has to keep clear of an obstacle at a place, however far it is there on the present path.
struct RowSite {
  PathPlace place;
  std::int32_t link = 0;
  std::int32_t obstacle = 0;
  bool operator==(const RowSite&) const = default;
};

// Rows for a solve from `path`: at every waypoint, at some places between, and at `sites`.
PlanRows rows_near(const Room& room, const PlanRequest& request, const Path& path, const std::vector<RowSite>& sites);

// Where a path has less than `clearance_m`: the places that are worst among their neighbours, looked at every 4 mm of
// motion, with the links that are nearest there.
std::vector<RowSite> sites_below(const Room& room, const PlanRequest& request, const Path& path, double clearance_m);

// No step of a theta or cable is beyond its limit by more than kStepTolerance.
bool steps_hold(const PlanRequest& request, const Path& path);

// At no waypoint a cable is below its floor or over its ceiling.
bool tensions_hold(const PlanRequest& request, const Path& path);

}  // namespace liana::planner
