#include "host/planning/planner/problem/plan_rows.hpp"

#include <algorithm>
#include <cmath>

namespace liana::planner {
namespace {

using Index = std::size_t;

constexpr double kSpacing_m = 0.15;     // of motion between the places with rows
constexpr std::int32_t kMaxPlaces = 4;  // per interval
constexpr double kLookSpacing_m = 0.004;
constexpr std::int32_t kMaxLooks = 256;  // per interval
constexpr double kNear_m = 0.10;         // beyond the margin: rows for links that are nearest among their neighbours
constexpr double kTight_m = 0.02;        // beyond the margin: rows for every link
constexpr double kStepShare = 0.6;       // of the step and cable limits: rows for steps that are larger
constexpr double kNearFloor_N =
    1.0;  // the core's plan rounds there: it is often a little over the floor, and never far below
constexpr double kNearCeiling_N = 40.0;    // what a round's change of theta can bring
constexpr double kSamePlane = 1.0 - 1e-9;  // cosine between normals

// Keeps both ends of a link before the plane that touches the box at its nearest point. The end that the link before
// shares is left out when that link has the same plane.
void add_planes(const PathPlace& place, std::int32_t link, std::int32_t obstacle, const clearance::Clearance& here,
                std::vector<ClearanceRow>& rows) {
  const Plane plane{here.normal, dot(here.normal, here.on_obstacle_m)};
  const ClearanceRow* last = rows.empty() ? nullptr : &rows.back();
  const bool shared = last != nullptr && last->plane && last->place == place && last->obstacle == obstacle &&
                      last->where.link == link - 1 && dot(last->plane->normal, plane.normal) > kSamePlane;
  if (!shared) rows.push_back({place, {link, 0.0}, obstacle, plane});
  rows.push_back({place, {link, 1.0}, obstacle, plane});
}

void add_rows(const Room& room, std::int32_t obstacle, const PathPlace& place, std::int32_t link,
              const clearance::Clearance& here, std::vector<ClearanceRow>& rows) {
  const bool has_edges = Index(obstacle) >= room.scene().spheres.size();
  const bool axis_outside = here.distance_m + room.link_radius_m() > 0.0;
  if (has_edges && axis_outside) return add_planes(place, link, obstacle, here, rows);
  rows.push_back({place, {link, here.share}, obstacle, {}});
}

// Clearances of all links from one obstacle, those below `within_m` exact.
std::vector<clearance::Clearance> clearances(const Room& room, const LinkPoints& points, std::int32_t obstacle,
                                             double within_m) {
  std::vector<clearance::Clearance> out;
  clearance::link_clearances(points.axis(), room.link_radius_m(), room.scene(), obstacle, within_m, out);
  return out;
}

clearance::Clearance exact(const Room& room, const LinkPoints& points, std::int32_t link, std::int32_t obstacle) {
  return clearance::clearance(clearance::link_capsule(points.axis(), link, room.link_radius_m()), room.scene(),
                              obstacle);
}

// No neighbouring link is nearer.
bool is_nearest(const std::vector<clearance::Clearance>& links, Index i) {
  return (i == 0 || links[i].distance_m < links[i - 1].distance_m) &&
         (i + 1 == links.size() || links[i].distance_m <= links[i + 1].distance_m);
}

// Rows at one place: links that are nearest among their neighbours, all that are very near, and those of the sites.
void add_place(const Room& room, const PlanRequest& request, const Path& path, const PathPlace& place,
               const std::vector<RowSite>& sites, std::vector<ClearanceRow>& rows) {
  const LinkPoints points = link_points(room.table(), theta_at(path, place));
  for (std::int32_t obstacle = 0; obstacle < clearance::obstacle_count(room.scene()); ++obstacle) {
    const double within_m = request.margin_m + kNear_m;
    const std::vector<clearance::Clearance> links = clearances(room, points, obstacle, within_m);
    for (Index i = 0; i < links.size(); ++i) {
      const std::int32_t link = static_cast<std::int32_t>(i);
      const bool near = links[i].distance_m < request.margin_m + (is_nearest(links, i) ? kNear_m : kTight_m);
      const bool asked = std::find(sites.begin(), sites.end(), RowSite{place, link, obstacle}) != sites.end();
      if (near || asked) add_rows(room, obstacle, place, link, exact(room, points, link, obstacle), rows);
    }
  }
}

bool is_movable(const PlanRequest& request, const Path& path, const PathPlace& place) {
  const bool at_end = place.share == 1.0 && Index(place.interval) + 2 == path.size();
  return request.tip_in_base.has_value() || !at_end;
}

// Rows for steps of more than `share` of their limit and `tolerance`.
void add_steps(const PlanRequest& request, const Path& path, double share, double tolerance, PlanRows& rows) {
  const RobotParams& table = request.robot.table;
  for (std::int32_t w = 0; w + 1 < static_cast<std::int32_t>(path.size()); ++w) {
    const ThetaVector &before = path[Index(w)], &after = path[Index(w) + 1];
    for (std::int32_t k = 0; k < table.theta_count(); ++k) {
      if (std::fabs(after[Index(k)] - before[Index(k)]) > share * request.max_step_rad + tolerance)
        rows.step.push_back({w, k});
    }
    const std::vector<double> short_m = cable_derivatives(table, before).length_m,
                              long_m = cable_derivatives(table, after).length_m;
    for (std::int32_t c = 0; c < table.cable_count(); ++c) {
      if (std::fabs(long_m[Index(c)] - short_m[Index(c)]) > share * request.max_cable_step_m() + tolerance)
        rows.cable.push_back({w, c});
    }
  }
}

// Rows for cables near their floor or ceiling, at waypoints that can move.
void add_tensions(const PlanRequest& request, const Path& path, PlanRows& rows) {
  const RobotParams& table = request.robot.table;
  const PlannedTension tension(table);
  const std::int32_t end = static_cast<std::int32_t>(path.size()) - (request.tip_in_base ? 0 : 1);
  for (std::int32_t w = 1; w < end; ++w) {
    const CableVector here_N = tension.at(path[Index(w)]);
    for (std::int32_t c = table.feed_count(); c < table.cable_count(); ++c) {
      const bool low = here_N[Index(c)] < table.tension.floor_motor_N + kNearFloor_N;
      if (low || here_N[Index(c)] > table.tension.ceiling_free_N - kNearCeiling_N) rows.tension.push_back({w, c});
    }
  }
}

std::int32_t places_of(const Room& room, const Path& path, Index w, double spacing_m, std::int32_t most) {
  return std::clamp(static_cast<std::int32_t>(std::ceil(room.motion_m(path[w], path[w + 1]) / spacing_m)), 1, most);
}

// With a single pose only the end counts, not the way.
bool single_pose(const PlanRequest& request) { return request.waypoints == 1; }

}  // namespace

PlanRows rows_near(const Room& room, const PlanRequest& request, const Path& path, const std::vector<RowSite>& sites) {
  std::vector<PathPlace> places;
  for (const RowSite& site : sites) places.push_back(site.place);
  for (Index w = 0; w + 1 < path.size(); ++w) {
    const std::int32_t count = single_pose(request) ? 1 : places_of(room, path, w, kSpacing_m, kMaxPlaces);
    for (std::int32_t s = 1; s <= count; ++s) places.push_back({static_cast<std::int32_t>(w), double(s) / count});
  }
  std::sort(places.begin(), places.end(), [](const PathPlace& a, const PathPlace& b) {
    return a.interval != b.interval ? a.interval < b.interval : a.share < b.share;
  });
  places.erase(std::unique(places.begin(), places.end()), places.end());
  PlanRows rows;
  for (const PathPlace& place : places) {
    if (is_movable(request, path, place)) add_place(room, request, path, place, sites, rows.clearance);
  }
  if (!single_pose(request)) add_steps(request, path, kStepShare, 0.0, rows);
  add_tensions(request, path, rows);
  return rows;
}

std::vector<RowSite> sites_below(const Room& room, const PlanRequest& request, const Path& path, double clearance_m) {
  std::vector<RowSite> out;
  const auto add_sites = [&](const PathPlace& place) {
    const LinkPoints points = link_points(room.table(), theta_at(path, place));
    for (std::int32_t obstacle = 0; obstacle < clearance::obstacle_count(room.scene()); ++obstacle) {
      const std::vector<clearance::Clearance> links = clearances(room, points, obstacle, clearance_m);
      for (Index i = 0; i < links.size(); ++i) {
        if (links[i].distance_m < clearance_m && is_nearest(links, i))
          out.push_back({place, static_cast<std::int32_t>(i), obstacle});
      }
    }
  };
  for (Index w = 0; w + 1 < path.size(); ++w) {
    const std::int32_t count = single_pose(request) ? 1 : places_of(room, path, w, kLookSpacing_m, kMaxLooks);
    double before = 1e300, here = 1e300;
    for (std::int32_t s = 1; s <= count + 1; ++s) {
      const PathPlace next{static_cast<std::int32_t>(w), double(s) / count},
          last{static_cast<std::int32_t>(w), double(s - 1) / count};
      const double after = s <= count ? room.look(theta_at(path, next)).nearest.distance_m : 1e300;
      if (s > 1 && here < clearance_m && here <= before && here < after && is_movable(request, path, last))
        add_sites(last);
      before = here;
      here = after;
    }
  }
  return out;
}

bool steps_hold(const PlanRequest& request, const Path& path) {
  if (single_pose(request)) return true;
  PlanRows rows;
  add_steps(request, path, 1.0, kStepTolerance, rows);
  return rows.step.empty() && rows.cable.empty();
}

bool tensions_hold(const PlanRequest& request, const Path& path) {
  const PlannedTension tension(request.robot.table);
  return std::none_of(path.begin(), path.end(),
                      [&](const ThetaVector& theta) { return tension.excess_N(theta) > 0.0; });
}

}  // namespace liana::planner
