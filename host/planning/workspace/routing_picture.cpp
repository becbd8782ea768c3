#include <cmath>

#include "firmware_like/cable/arm/cables.hpp"
#include "host/base/svg/svg.hpp"
#include "host/planning/workspace/picture.hpp"

namespace liana::workspace {
namespace {

constexpr double kRoutingWidth_px = 1080.0, kRoutingHeight_px = 420.0;
constexpr svg::Pixel kDiscCentre_px{190.0, 225.0};
constexpr double kDiscRadius_px = 140.0, kHole_px = 6.0;
constexpr double kRoutingLeft_px = 430.0, kAlong_px = 600.0;  // of the arm, unrolled
constexpr double kRoutingTop_px = 85.0, kAcross_px = 280.0;
constexpr std::string_view kColours[cable::kMaxSegments] = {"#1f65a3", "#d6771e", "#2a8a4a", "#b0304a",
                                                            "#6b4fa0", "#8a6a3a", "#c060a0", "#4a4a4a"};

using Index = std::size_t;

double arm_length_m(const cable::RobotParams& table, std::int32_t segments) {
  double length_m = 0.0;
  for (Index j = 0; j < static_cast<Index>(segments); ++j)
    length_m += table.segment[j].modules * table.segment[j].module_length_m;
  return length_m;
}

// The disc as seen from the tip: where every cable's hole is, and which segment the cable ends in.
void draw_disc(svg::Svg& svg, const config::RobotConfig& robot, const cable::CableLayout& layout) {
  const double px_per_m = kDiscRadius_px / robot.module_radius_m;
  svg.text({kDiscCentre_px.x, 40.0}, "holes of a disc: y to the right, z up", {.anchor = "middle", .bold = true});
  svg.circle(kDiscCentre_px, kDiscRadius_px, {.fill = "#f2f2f2", .stroke = "#888888"});
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    const double y_px = px_per_m * layout.hole_y_m[c], z_px = px_per_m * layout.hole_z_m[c];
    const svg::Pixel at{kDiscCentre_px.x + y_px, kDiscCentre_px.y - z_px};
    svg.circle(at, kHole_px, {.fill = kColours[static_cast<Index>(layout.segment[c])]});
    const double out = 1.0 - 20.0 / std::hypot(y_px, z_px);
    svg.text({kDiscCentre_px.x + out * y_px, kDiscCentre_px.y - out * z_px + 4.0}, std::to_string(c + 1),
             {.size = 11.0, .anchor = "middle"});
  }
}

// The straight arm with its discs' surface unrolled: every cable from the root to the disc that it ends at.
void draw_routing(svg::Svg& svg, const cable::RobotParams& table, const cable::CableLayout& layout) {
  const double whole_m = arm_length_m(table, table.segment_count);
  const auto x_px = [&](double along_m) { return kRoutingLeft_px + kAlong_px * along_m / whole_m; };
  const double row_px = kAcross_px / layout.cable_count;
  svg.text({kRoutingLeft_px + kAlong_px / 2.0, 40.0}, "cables from root to anchor, numbered as their drives",
           {.anchor = "middle", .bold = true});
  double along_m = 0.0;
  for (std::int32_t j = 0; j <= table.segment_count; ++j) {
    svg.line({x_px(along_m), kRoutingTop_px - 15.0}, {x_px(along_m), kRoutingTop_px + kAcross_px},
             {.stroke = "#999999", .dashed = j > 0});
    if (j == table.segment_count) break;
    const double next_m = arm_length_m(table, j + 1);
    svg.text({x_px(0.5 * (along_m + next_m)), kRoutingTop_px - 20.0}, "segment " + std::to_string(j + 1),
             {.size = 12.0, .anchor = "middle", .colour = kColours[static_cast<Index>(j)]});
    along_m = next_m;
  }
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    const double y_px = kRoutingTop_px + row_px * (static_cast<double>(c) + 0.5);
    const std::string_view colour = kColours[static_cast<Index>(layout.segment[c])];
    const double end_px = x_px(arm_length_m(table, layout.segment[c] + 1));
    svg.line({kRoutingLeft_px, y_px}, {end_px, y_px}, {.stroke = colour, .width = 2.0});
    svg.circle({end_px, y_px}, 3.0, {.fill = colour});
    svg.text({kRoutingLeft_px - 8.0, y_px + 3.0}, std::to_string(c + 1), {.size = 10.0, .anchor = "end"});
  }
  svg.text({kRoutingLeft_px, kRoutingTop_px + kAcross_px + 22.0}, "0 m", {.size = 11.0});
  svg.text({kRoutingLeft_px + kAlong_px, kRoutingTop_px + kAcross_px + 22.0}, svg::short_number(whole_m, 3) + " m",
           {.size = 11.0, .anchor = "end"});
}

}  // namespace

std::string routing_picture(const config::RobotConfig& robot) {
  const cable::CableLayout layout = cable_layout(robot.table);
  svg::Svg svg(kRoutingWidth_px, kRoutingHeight_px, "Cable routing of " + robot.name);
  draw_disc(svg, robot, layout);
  draw_routing(svg, robot.table, layout);
  return svg.document();
}

}  // namespace liana::workspace
