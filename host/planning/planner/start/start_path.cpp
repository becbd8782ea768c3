#include "host/planning/planner/start/start_path.hpp"

#include <algorithm>

#include "host/planning/planner/problem/plan_problem.hpp"
#include "host/planning/planner/start/explore.hpp"
#include "host/planning/planner/start/relax.hpp"
#include "host/planning/planner/start/retract.hpp"

namespace liana::planner {
namespace {

using Index = std::size_t;

// Thetas that are held from the first waypoint on.
std::uint32_t always_held(const PlanRequest& request) {
  std::uint32_t mask = 0;
  for (const HeldPhase& phase : request.held) {
    if (phase.from_share == 0.0) mask |= 1u << phase.theta;
  }
  return mask;
}

// Puts held thetas on their values where they are held, and brings them there evenly before.
void apply_phases(const PlanRequest& request, Path& path) {
  const std::int32_t count = static_cast<std::int32_t>(path.size());
  for (const HeldPhase& phase : request.held) {
    const Index k = static_cast<Index>(phase.theta);
    const double first = phase.from_share * (count - 1);
    double gap = 0.0;  // between the path and the value where the phase begins
    for (std::int32_t w = count - 1; w >= 0; --w) {
      if (is_held(phase, w, count)) {
        gap = phase.value_rad - path[Index(w)][k];
        if (w > 0) path[Index(w)][k] = phase.value_rad;
      } else {
        path[Index(w)][k] += gap * w / first;
      }
    }
  }
}

Path explored(const Room& room, const PlanRequest& request, const ThetaVector& from, const ThetaVector& to,
              std::uint64_t sequence, const PlanControl& control) {
  const Path found = explore(room, {from, to, always_held(request), request.margin_m, sequence}, control.cancelled);
  return found.empty() ? found : shortcut(room, found, request.margin_m, sequence);
}

// Out of the tight places at both ends, and between them straight where that is free, else explored.
Path by_retracting(const Room& room, const PlanRequest& request, const PathEnds& ends, const PlanControl& control) {
  const std::uint32_t mask = always_held(request);
  Path out = retract(room, ends.from_rad, mask, request.margin_m);
  Path in = retract(room, ends.to_rad, mask, request.margin_m);
  if (out.size() + in.size() == 2) return {};
  std::reverse(in.begin(), in.end());
  const Path middle = explored(room, request, out.back(), in.front(), 1, control);
  if (middle.empty()) return {};
  out.insert(out.end(), middle.begin() + 1, middle.end() - 1);
  out.insert(out.end(), in.begin(), in.end());
  return out;
}

}  // namespace

const char* name_of(StartKind kind) {
  switch (kind) {
    case StartKind::straight:
      return "straight";
    case StartKind::retract:
      return "retract";
    case StartKind::explore_1:
      return "explore 1";
    case StartKind::explore_2:
      return "explore 2";
    case StartKind::explore_3:
      return "explore 3";
  }
  return "";
}

Path straight_path(const PlanRequest& request, const PathEnds& ends) {
  Path path;
  const std::int32_t count = std::max(2, request.waypoints);
  for (std::int32_t w = 0; w < count; ++w) path.push_back(between(ends.from_rad, ends.to_rad, double(w) / (count - 1)));
  path.back() = ends.to_rad;
  apply_phases(request, path);
  return path;
}

Path start_path(const Room& room, const PlanRequest& request, const PathEnds& ends, StartKind kind,
                const PlanControl& control) {
  if (kind == StartKind::straight) return relax(room, request, straight_path(request, ends));
  Path path;
  if (kind == StartKind::retract) {
    path = by_retracting(room, request, ends, control);
  } else {
    const auto sequence = static_cast<std::uint64_t>(kind) - static_cast<std::uint64_t>(StartKind::explore_1) + 1;
    path = explored(room, request, ends.from_rad, ends.to_rad, sequence, control);
  }
  if (path.empty()) return path;
  path = resample(room, path, request.waypoints);
  apply_phases(request, path);
  return relax(room, request, path);
}

}  // namespace liana::planner
