// Start paths for the solver, tried in a fixed order until one leads to a plan.
//
// 1. straight: the straight line in theta, relaxed
// 2. retract: when an end is in a tight place, the way out of it (retract.hpp) and a straight or explored rest, relaxed
// 3. explore: random trees (explore.hpp), straightened and relaxed, with three sequences of random numbers
#pragma once

#include <string>

#include "host/planning/planner/problem/room.hpp"

namespace liana::planner {

using namespace cable;  // this room serves the cable arm only

enum class StartKind { straight, retract, explore_1, explore_2, explore_3 };
constexpr std::array<StartKind, 5> kStartKinds{StartKind::straight, StartKind::retract, StartKind::explore_1,
                                               StartKind::explore_2, StartKind::explore_3};
const char* name_of(StartKind kind);

// Ends of the path: the first waypoint, and what the last one is at the start of the solve.
struct PathEnds {
  ThetaVector from_rad{};
  ThetaVector to_rad{};
};

// The straight line in theta with held phases in force; not relaxed.
Path straight_path(const PlanRequest& request, const PathEnds& ends);

// A start path with request.waypoints waypoints; empty when this kind leads to none.
Path start_path(const Room& room, const PlanRequest& request, const PathEnds& ends, StartKind kind,
                const PlanControl& control);

}  // namespace liana::planner
