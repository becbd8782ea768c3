#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"
#include "host/planning/workspace/picture.hpp"
#include "host/planning/workspace/views.hpp"

namespace liana::workspace {
namespace {

constexpr double kBorder_m = 0.25;      // around everything that is drawn
constexpr double kDrawing_px = 1000.0;  // widths of top and front view together
constexpr double kPlaneLeft_px = 70.0, kPlaneTop_px = 80.0, kGap_px = 80.0, kBottom_px = 60.0, kRight_px = 30.0;
constexpr double kLegendWidth_px = 480.0, kLegendHeight_px = 470.0;
constexpr double kRow_px = 21.0;

using Space = std::array<svg::AxisRange, 3>;

void include(Space& space, const Vec3& low_m, const Vec3& high_m) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    space[axis].low = std::min(space[axis].low, low_m[axis] - kBorder_m);
    space[axis].high = std::max(space[axis].high, high_m[axis] + kBorder_m);
  }
}

// What the views must show: base, region, arm and scene.
Space shown_space(const ReachArm& arm, const ArmDrawn& drawn, const config::SceneConfig* scene, const Region& region) {
  Space space;
  space.fill({-kBorder_m, kBorder_m});
  include(space, region.extent_m[0], region.extent_m[1]);
  for (const Vec3& point : arm.centre_line(drawn.angle_rad)) include(space, point, point);
  if (scene == nullptr) return space;
  for (const config::SceneBox& box : scene->boxes) {
    for (const Vec3& corner : box_corners(box)) include(space, corner, corner);
  }
  for (const config::SceneSphere& sphere : scene->spheres) {
    const Vec3 radius{sphere.radius_m, sphere.radius_m, sphere.radius_m};
    include(space, subtract(sphere.center_m, radius), add(sphere.center_m, radius));
  }
  for (const config::SceneConvex& body : scene->convex)
    include(space, subtract(body.center_m, body.half_extent_m), add(body.center_m, body.half_extent_m));
  if (scene->rod) include(space, scene->rod->pose.position_m, scene->rod->pose.position_m);
  return space;
}

double length(const svg::AxisRange& range) { return range.high - range.low; }

// Top view above the side view, front view right of it, as in a technical drawing.
struct Layout {
  View top, side, front;
  double width_px = 0.0, height_px = 0.0;
  svg::Pixel legend;
};

Layout lay_out(const Space& space) {
  const double scale = kDrawing_px / (length(space[0]) + length(space[1]));  // px per metre
  const double x = scale * length(space[0]), y = scale * length(space[1]), z = scale * length(space[2]);
  const double right_column = kPlaneLeft_px + x + kGap_px;
  const double lower_row = kPlaneTop_px + std::max(y, kLegendHeight_px) + kGap_px;
  Layout layout;
  layout.top = {{{kPlaneLeft_px, lower_row - kGap_px - y}, x, y, space[0], space[1]}, 0, 1};
  layout.side = {{{kPlaneLeft_px, lower_row}, x, z, space[0], space[2]}, 0, 2};
  layout.front = {{{right_column, lower_row}, y, z, space[1], space[2]}, 1, 2};
  layout.legend = {right_column - 10.0, kPlaneTop_px};
  layout.width_px = right_column + std::max(y, kLegendWidth_px) + kRight_px;
  layout.height_px = lower_row + z + kBottom_px;
  return layout;
}

std::string numbered(std::string_view name, std::size_t number) {
  return std::string(name) + " " + std::to_string(number);
}

std::string point_name(const ReachArm& arm, const PointOnArm& point) {
  return point.node == arm.node_count ? "the tip" : numbered(arm.node_name, static_cast<std::size_t>(point.node));
}

std::string metres(double value_m) { return svg::short_number(value_m, 3); }

std::string origin_text(const Region& region) {
  const Vec3& origin = region.origin_in_base_m;
  if (norm(origin) == 0.0) return "the base";
  return "(" + metres(origin[0]) + ", " + metres(origin[1]) + ", " + metres(origin[2]) + ")";
}

std::string extent_text(const Region& region) {
  std::string text;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    text += std::string(axis == 0 ? "" : ",  ") + "xyz"[axis] + " " + metres(region.extent_m[0][axis]) + " .. " +
            metres(region.extent_m[1][axis]);
  }
  return text + " m";
}

// "theta 2 38 %, theta 1 35 %, ...": the limits that bind most often at the outer boundary.
std::string binding_text(const ReachArm& arm, const Region& region) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i) {
    if (region.outer_binding_share[i] > 0.0) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return region.outer_binding_share[a] > region.outer_binding_share[b];
  });
  std::string text;
  for (std::size_t k = 0; k < std::min<std::size_t>(order.size(), 3); ++k) {
    text += numbered(arm.angle_name, order[k] + 1) + " " +
            svg::short_number(100.0 * region.outer_binding_share[order[k]], 0) + " %, ";
  }
  return text + "no limit " + svg::short_number(100.0 * region.outer_stretched_share, 0) + " %";
}

// Rows of the legend from above; each call writes one and moves on.
class Legend {
 public:
  Legend(svg::Svg& svg, svg::Pixel corner) : svg_(svg), at_(corner) {}

  void heading(std::string_view words) {
    at_.y += 8.0;
    svg_.text(at_, words, {.size = 13.0, .bold = true});
    at_.y += kRow_px;
  }
  void words(std::string_view words) {
    svg_.text(at_, words, {.size = 12.0});
    at_.y += kRow_px - 2.0;
  }
  void swatch(const svg::Look& look, std::string_view words) {
    svg_.rectangle({at_.x, at_.y - 11.0}, 26.0, 13.0, look);
    svg_.text({at_.x + 36.0, at_.y}, words, {.size = 12.0});
    at_.y += kRow_px - 2.0;
  }
  void dot(const svg::Look& look, double radius, std::string_view words) {
    svg_.circle({at_.x + 13.0, at_.y - 4.5}, radius, look);
    svg_.text({at_.x + 36.0, at_.y}, words, {.size = 12.0});
    at_.y += kRow_px - 2.0;
  }

 private:
  svg::Svg& svg_;
  svg::Pixel at_;
};

void describe_heat(Legend& legend, double top) {
  legend.heading("Region and mobility");
  legend.swatch({.fill = kRegionColour, .stroke = kOutlineColour, .width = 1.6},
                "reached (outline by 5 deg); no cell: fewer than 3 samples");
  legend.words("cells: travel in the worst direction (m/rad), mean over the depth");
  for (std::size_t i = 0; i < kHeatClasses; ++i) {
    const double step = top / kHeatClasses;
    legend.swatch({.fill = kHeatColours[i]}, svg::short_number(static_cast<double>(i) * step, 2) + " .. " +
                                                 svg::short_number(static_cast<double>(i + 1) * step, 2));
  }
}

// The limits that the outlines are coloured by.
void describe_binding(Legend& legend, const ReachArm& arm, const Region& region) {
  std::uint32_t seen = 0;
  for (const Outline& outline : region.outline) {
    for (const OutlineSector& sector : outline) seen |= sector.outer_binding;
  }
  if (seen == 0) return;
  legend.words("colour on the outline: limit that binds there; none: stretched arm");
  for (std::int32_t angle = 1; angle <= arm.angle_count; ++angle) {
    if (seen >> (angle - 1) & 1u)
      legend.swatch({.fill = theta_colour(angle)}, numbered(arm.angle_name, static_cast<std::size_t>(angle)));
  }
}

void describe_objects(Legend& legend, const ReachArm& arm, const config::SceneConfig* scene, const std::string& point) {
  legend.heading("Drawn to scale");
  legend.swatch({.fill = kArmColour}, "arm, " + std::string(arm.node_name) + "s as dots; black square: base");
  legend.dot({.fill = kMarkColour}, 4.5, point);
  if (scene == nullptr) return;
  for (std::size_t i = 0; i < scene->boxes.size(); ++i) {
    const std::string_view colour = kBoxColours[std::min(i, kBoxColours.size() - 1)];
    legend.swatch({.fill = colour, .stroke = colour, .opacity = 0.5},
                  scene->boxes[i].name + (i == 0 && scene->slit ? " (the slit is between the plates)" : ""));
  }
  for (const config::SceneSphere& sphere : scene->spheres)
    legend.dot({.fill = kSphereColour, .opacity = 0.55}, 7.0, sphere.name);
  for (std::size_t i = 0; i < scene->convex.size(); ++i) {
    const std::string& name = scene->convex[i].name;  // pieces of a chain share it
    if (i == 0 || name != scene->convex[i - 1].name)
      legend.swatch({.fill = kConvexColour, .stroke = kConvexColour, .opacity = 0.5}, name);
  }
  if (scene->rod) legend.dot({.stroke = kRodColour, .width = 2.0}, 7.0, "press rod, inside the ring");
}

void describe_region(Legend& legend, const ReachArm& arm, const RegionRequest& request, const Region& region) {
  legend.heading("In figures");
  legend.words("extent: " + extent_text(region));
  legend.words("distance from " + origin_text(region) + ": " + metres(region.nearest_m) + " .. " +
               metres(region.farthest_m) + " m (" + std::string(arm.length_name) + " " + metres(region.length_m) +
               " m)");
  legend.words("binds at the outer boundary: " + binding_text(arm, region));
  legend.words("joint limits only: obstacles take nothing away");
  legend.words(std::to_string(request.samples) + " samples, seed " + std::to_string(request.seed));
}

}  // namespace

std::string held_text(const ReachArm& arm, std::uint32_t held_mask, const AngleVector& held_rad) {
  std::string text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(arm.angle_count); ++i) {
    if ((held_mask >> i & 1u) == 0) continue;
    text += (text.empty() ? "" : ", ") + numbered(arm.angle_name, i + 1) + " = " +
            svg::short_number(held_rad[i] / kDegree, 3);
  }
  return text.empty() ? "none" : text + " deg";
}

std::string region_picture(const ReachArm& arm, const ArmDrawn& drawn, const config::SceneConfig* scene,
                           const RegionRequest& request, const Region& region) {
  const Space space = shown_space(arm, drawn, scene, region);
  const Layout layout = lay_out(space);
  const std::string point = point_name(arm, request.point);
  const std::string title = "Where " + point + " of " + drawn.name + " can go";
  svg::Svg svg(layout.width_px, layout.height_px, title);
  svg.text({kPlaneLeft_px - 40.0, 34.0}, title, {.size = 20.0, .bold = true});
  svg.text({kPlaneLeft_px - 40.0, 56.0}, "held: " + held_text(arm, request.point.held_mask, request.held_rad),
           {.size = 13.0});

  constexpr std::array kAxisTitles{"x (m)", "y (m)", "z (m)"};
  constexpr std::array kViewNames{"front view, from +x", "side view, from -y",
                                  "top view, from +z"};  // by the axis that is looked along
  const std::array<const View*, 3> views{&layout.front, &layout.side, &layout.top};
  std::array<std::map<Cell, double>, 3> cells;
  double top = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    cells[i] = heat_cells(*views[i], region.samples);
    for (const auto& cell : cells[i]) top = std::max(top, cell.second);
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const View& view = *views[i];
    svg::draw_axes(svg, view.axes, kAxisTitles[view.right], kAxisTitles[view.up]);
    draw_outline(svg, view, region.outline[i], {.fill = kRegionColour});
    draw_heat(svg, view, cells[i], top);
    draw_outline(svg, view, region.outline[i], {.stroke = kOutlineColour, .width = 1.6});
    draw_binding(svg, view, region.outline[i]);
    if (scene != nullptr) draw_scene(svg, view, *scene);
    draw_arm(svg, view, arm, drawn, request.point.node);
    svg.text({view.axes.corner.x + 8.0, view.axes.corner.y + 18.0}, kViewNames[i],
             {.size = 13.0, .bold = true, .halo = true});
  }
  Legend legend(svg, layout.legend);
  describe_heat(legend, top);
  describe_binding(legend, arm, region);
  describe_objects(legend, arm, scene, point);
  describe_region(legend, arm, request, region);
  return svg.document();
}

}  // namespace liana::workspace
