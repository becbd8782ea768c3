// The three views of a space picture: which axes they show, where they stand, and what is drawn in them.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "host/base/svg/axes.hpp"
#include "host/model/config/config.hpp"
#include "host/planning/workspace/picture.hpp"
#include "host/planning/workspace/region.hpp"

namespace liana::workspace {

// Looking along one base axis: coordinate `right` of the base frame to the right, `up` upwards.
struct View {
  svg::Axes axes;
  std::size_t right = 0;
  std::size_t up = 1;

  svg::Pixel at(const Vec3& point_in_base_m) const { return axes.at(point_in_base_m[right], point_in_base_m[up]); }
};

// Mean mobility of the samples seen in each cell, kHeatCell_px wide, counted from the lower left corner of the view.
constexpr double kHeatCell_px = 8.0;
constexpr std::size_t kMinCellSamples = 3;  // cells with fewer say nothing
using Cell = std::pair<int, int>;           // row from below, column from the left
std::map<Cell, double> heat_cells(const View& view, const std::vector<ReachedPoint>& samples);

// Classes of mobility, from 0 to the largest mean.
constexpr std::size_t kHeatClasses = 5;
constexpr std::array<std::string_view, kHeatClasses> kHeatColours{"#deebf7", "#b3d3ec", "#7fb8de", "#3f8fc5",
                                                                  "#1f65a3"};

// Cells in the colour of their class; `top_m_per_rad` is the upper end of the highest one.
void draw_heat(svg::Svg& svg, const View& view, const std::map<Cell, double>& cells, double top_m_per_rad);
// Over the outline: the limits that bind there, one colour each; where several do, they lie inside each other.
void draw_binding(svg::Svg& svg, const View& view, const Outline& outline);
// The region's outline as seen in the view; `fill` or `stroke` may be none.
void draw_outline(svg::Svg& svg, const View& view, const Outline& outline, const svg::Look& look);
// Boxes (first, second, ... in fixed colours), spheres, convex bodies, and the rod with a ring around it.
void draw_scene(svg::Svg& svg, const View& view, const config::SceneConfig& scene);
// Links as one thick line, nodes as dots, base and tip marked.
void draw_arm(svg::Svg& svg, const View& view, const ReachArm& arm, const ArmDrawn& drawn, std::int32_t marked_node);

constexpr std::string_view kRegionColour = "#eef4fa";
constexpr std::string_view kOutlineColour = "#17436b";
constexpr std::string_view kArmColour = "#f28e2b";
constexpr std::string_view kNodeColour = "#7a3e00";
constexpr std::string_view kMarkColour = "#d62728";
constexpr std::string_view kSphereColour = "#9467bd";
constexpr std::string_view kConvexColour = "#17becf";
constexpr std::string_view kRodColour = "#e377c2";
constexpr std::array<std::string_view, 3> kBoxColours{"#2ca02c", "#7f7f7f", "#8c564b"};

// Colour of theta 1, 2, ...; repeats after ten.
std::string_view theta_colour(std::int32_t theta);

// Corners of a box in the base frame.
std::array<Vec3, 8> box_corners(const config::SceneBox& box);

}  // namespace liana::workspace
