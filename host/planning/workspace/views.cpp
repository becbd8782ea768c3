#include "host/planning/workspace/views.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/model/config/convex_shape.hpp"

namespace liana::workspace {
namespace {

constexpr double kMinArm_px = 3.0;
constexpr double kRing_px = 7.0;
constexpr double kBinding_px = 6.0;  // width of the first limit that binds; each further one is 3 px narrower
constexpr std::array<std::string_view, 10> kThetaColours{"#5b6fd6", "#bcbd22", "#59a14f", "#b07aa1", "#9c755f",
                                                         "#e15759", "#76b7b2", "#edc948", "#ff9da7", "#79706e"};

double pixels_per_m(const View& view) { return view.axes.width / (view.axes.x.high - view.axes.x.low); }

// Corners of the convex hull, in order (Andrew's monotone chain).
std::vector<svg::Pixel> convex_hull(std::vector<svg::Pixel> points) {
  std::sort(points.begin(), points.end(),
            [](const svg::Pixel& a, const svg::Pixel& b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  const auto left_turn = [](const svg::Pixel& a, const svg::Pixel& b, const svg::Pixel& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0.0;
  };
  std::vector<svg::Pixel> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t start = hull.size();
    for (const svg::Pixel& point : points) {
      while (hull.size() >= start + 2 && !left_turn(hull[hull.size() - 2], hull.back(), point)) hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

std::size_t heat_class(double value, double top) {
  if (top <= 0.0) return 0;
  return std::min(static_cast<std::size_t>(value / top * kHeatClasses), kHeatClasses - 1);
}

// Points of a convex body that its outline is the hull of, round parts by 5 deg.
std::vector<svg::Pixel> ends_in(const View& view, const config::SceneConvex& body) {
  constexpr int kDirections = 72;
  std::vector<svg::Pixel> out;
  for (const Vec3& point : body.points_m) out.push_back(view.at(point));
  for (int i = 0; i < kDirections; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kDirections;
    Vec3 direction{};
    direction[view.right] = std::cos(angle);
    direction[view.up] = std::sin(angle);
    out.push_back(view.at(add(config::farthest_point(body, direction), scale(direction, body.round_m))));
  }
  return out;
}

}  // namespace

std::string_view theta_colour(std::int32_t theta) {
  return kThetaColours[static_cast<std::size_t>(theta - 1) % kThetaColours.size()];
}

std::array<Vec3, 8> box_corners(const config::SceneBox& box) {
  std::array<Vec3, 8> corners;
  for (std::size_t i = 0; i < 8; ++i) {
    corners[i] = box.center_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      corners[i] = add(corners[i],
                       scale(box.rotation[axis], i >> axis & 1u ? box.half_extent_m[axis] : -box.half_extent_m[axis]));
    }
  }
  return corners;
}

std::map<Cell, double> heat_cells(const View& view, const std::vector<ReachedPoint>& samples) {
  std::map<Cell, std::pair<double, std::size_t>> sums;
  for (const ReachedPoint& sample : samples) {
    const svg::Pixel at = view.at(sample.point_in_base_m);
    const Cell cell{static_cast<int>(std::floor((view.axes.corner.y + view.axes.height - at.y) / kHeatCell_px)),
                    static_cast<int>(std::floor((at.x - view.axes.corner.x) / kHeatCell_px))};
    auto& [sum, count] = sums[cell];
    sum += sample.mobility_m_per_rad;
    ++count;
  }
  std::map<Cell, double> means;
  for (const auto& [cell, sum] : sums) {
    if (sum.second >= kMinCellSamples) means[cell] = sum.first / static_cast<double>(sum.second);
  }
  return means;
}

void draw_heat(svg::Svg& svg, const View& view, const std::map<Cell, double>& cells, double top_m_per_rad) {
  std::array<std::vector<svg::Svg::Bar>, kHeatClasses> bars;
  for (auto cell = cells.begin(); cell != cells.end();) {
    const auto [row, first] = cell->first;
    const std::size_t kind = heat_class(cell->second, top_m_per_rad);
    int column = first;
    while (cell != cells.end() && cell->first == Cell{row, column} && heat_class(cell->second, top_m_per_rad) == kind)
      ++cell, ++column;
    bars[kind].push_back({{view.axes.corner.x + first * kHeatCell_px,
                           view.axes.corner.y + view.axes.height - (row + 0.5) * kHeatCell_px},
                          (column - first) * kHeatCell_px});
  }
  for (std::size_t kind = 0; kind < kHeatClasses; ++kind) svg.bars(bars[kind], kHeatCell_px, kHeatColours[kind]);
}

void draw_outline(svg::Svg& svg, const View& view, const Outline& outline, const svg::Look& look) {
  const auto pixel = [&](const std::array<double, 2>& place_m) { return view.axes.at(place_m[0], place_m[1]); };
  const auto gap = static_cast<std::size_t>(
      std::find_if(outline.begin(), outline.end(), [](auto& s) { return !s.seen; }) - outline.begin());
  // Runs of neighbouring sectors: out along the outer ends, back along the inner ones. Counting starts behind a gap, if
  // there is one.
  std::vector<svg::Pixel> there, back;
  const auto close_run = [&] {
    there.insert(there.end(), back.rbegin(), back.rend());
    if (there.size() >= 3) svg.polygon(there, look);
    there.clear();
    back.clear();
  };
  const bool all_round = gap == kOutlineSectors;
  for (std::size_t k = 0; k < kOutlineSectors; ++k) {
    const OutlineSector& sector = outline[(gap + k) % kOutlineSectors];
    if (!sector.seen) {
      close_run();
      continue;
    }
    there.push_back(pixel(sector.outer_m));
    if (!all_round) back.push_back(pixel(sector.inner_m));
  }
  close_run();
}

void draw_binding(svg::Svg& svg, const View& view, const Outline& outline) {
  const auto pixel = [&](const OutlineSector& sector) { return view.axes.at(sector.outer_m[0], sector.outer_m[1]); };
  for (std::size_t k = 0; k < kOutlineSectors; ++k) {
    const OutlineSector &here = outline[k], &next = outline[(k + 1) % kOutlineSectors];
    if (!here.seen || !next.seen) continue;
    double width_px = kBinding_px;
    for (std::int32_t theta = 1; theta <= kMaxAngles && width_px > 0.0; ++theta) {
      if ((here.outer_binding & next.outer_binding) >> (theta - 1) & 1u) {
        svg.polyline({pixel(here), pixel(next)}, {.stroke = theta_colour(theta), .width = width_px});
        width_px -= 3.0;
      }
    }
  }
}

void draw_scene(svg::Svg& svg, const View& view, const config::SceneConfig& scene) {
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    std::vector<svg::Pixel> corners;
    for (const Vec3& corner : box_corners(scene.boxes[i])) corners.push_back(view.at(corner));
    const std::string_view colour = kBoxColours[std::min(i, kBoxColours.size() - 1)];
    svg.polygon(convex_hull(corners), {.fill = colour, .opacity = 0.25});
    svg.polygon(convex_hull(corners), {.stroke = colour, .width = 1.2});
  }
  for (const config::SceneSphere& sphere : scene.spheres) {
    svg.circle(view.at(sphere.center_m), sphere.radius_m * pixels_per_m(view),
               {.fill = kSphereColour, .opacity = 0.55});
  }
  for (const config::SceneConvex& body : scene.convex) {
    const std::vector<svg::Pixel> outline = convex_hull(ends_in(view, body));
    svg.polygon(outline, {.fill = kConvexColour, .opacity = 0.25});
    svg.polygon(outline, {.stroke = kConvexColour, .width = 1.2});
  }
  if (!scene.rod) return;
  const svg::Pixel rod = view.at(scene.rod->pose.position_m);
  svg.circle(rod, scene.rod->radius_m * pixels_per_m(view), {.fill = kRodColour});
  svg.circle(rod, kRing_px, {.stroke = kRodColour, .width = 2.0});
}

void draw_arm(svg::Svg& svg, const View& view, const ReachArm& arm, const ArmDrawn& drawn, std::int32_t marked_node) {
  std::vector<svg::Pixel> line;
  for (const Vec3& point : arm.centre_line(drawn.angle_rad)) line.push_back(view.at(point));
  const double width_px = std::max(kMinArm_px, 2.0 * drawn.radius_m * pixels_per_m(view));
  svg.polyline(line, {.stroke = kArmColour, .width = width_px});
  for (std::int32_t m = 1; m <= arm.node_count; ++m) {
    const svg::Pixel node = view.at(arm.motion(m, drawn.angle_rad).point_in_base_m);
    svg.circle(node, m == marked_node ? 4.5 : 2.5, {.fill = m == marked_node ? kMarkColour : kNodeColour});
  }
  const svg::Pixel base = view.at({0.0, 0.0, 0.0});
  svg.rectangle({base.x - 5.0, base.y - 5.0}, 10.0, 10.0, {.fill = "#222222"});
}

}  // namespace liana::workspace
