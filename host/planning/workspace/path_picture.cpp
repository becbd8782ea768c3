#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "firmware_like/math/trig.hpp"
#include "host/base/svg/axes.hpp"
#include "host/planning/workspace/picture.hpp"
#include "host/planning/workspace/views.hpp"

namespace liana::workspace {
namespace {

constexpr double kWidth_px = 1000.0, kHeight_px = 940.0;
constexpr double kLeft_px = 80.0, kPlotWidth_px = 880.0, kPlotHeight_px = 200.0;
constexpr std::array<double, 3> kPlotTop_px{110.0, 385.0, 660.0};
constexpr double kStrip_px = 14.0;      // height of the strip that says which theta is nearest
constexpr double kLabelRoom_px = 52.0;  // shorter runs of the strip get no label
constexpr double kMinAdvance_px = 0.7;
constexpr std::size_t kMaxWaypointLines = 25;
constexpr std::string_view kLineColour = "#1f65a3";
constexpr std::string_view kWorstColour = "#d62728";

svg::Axes plot(std::size_t index, const svg::AxisRange& y, bool log_y) {
  return {{kLeft_px, kPlotTop_px[index]}, kPlotWidth_px, kPlotHeight_px, {0.0, 100.0}, y, log_y};
}

using Value = std::function<double(const PathPoint&)>;

// The curve of a value, broken where it is not finite; places nearer than kMinAdvance_px to the last one are left
// out.
void draw_curve(svg::Svg& svg, const svg::Axes& axes, const PathStatus& report, const Value& value,
                const svg::Look& look) {
  std::vector<svg::Pixel> run;
  for (const PathPoint& point : report.points) {
    if (!std::isfinite(value(point))) {
      svg.polyline(run, look);
      run.clear();
      continue;
    }
    const svg::Pixel at = axes.at(100.0 * point.way, value(point));
    const bool last = &point == &report.points.back();
    if (run.empty() || last || at.x - run.back().x >= kMinAdvance_px) run.push_back(at);
  }
  svg.polyline(run, look);
}

void mark_worst(svg::Svg& svg, const svg::Axes& axes, const PathPoint& point, double value, const std::string& words) {
  const svg::Pixel at = axes.at(100.0 * point.way, value);
  svg.circle(at, 5.0, {.stroke = kWorstColour, .width = 2.0});
  const bool right_half = at.x > kLeft_px + kPlotWidth_px / 2.0;
  const bool low = at.y > axes.corner.y + axes.height - 50.0;  // no room for words below
  svg.text({at.x + (right_half ? -10.0 : 10.0), at.y + (low ? -12.0 : 22.0)}, words,
           {.size = 12.0, .anchor = right_half ? "end" : "start", .colour = kWorstColour, .bold = true, .halo = true});
}

void draw_waypoints(svg::Svg& svg, const svg::Axes& axes, const PathStatus& report) {
  if (report.waypoint_way.size() > kMaxWaypointLines) return;
  for (std::size_t i = 0; i < report.waypoint_way.size(); ++i) {
    const svg::Pixel top = axes.at(100.0 * report.waypoint_way[i], axes.y.high);
    svg.line(top, {top.x, top.y + axes.height}, {.stroke = "#888888", .dashed = true});
    svg.text({top.x, top.y - 5.0}, std::to_string(i + 1), {.size = 11.0, .anchor = "middle", .colour = "#666666"});
  }
}

std::string percent(const PathPoint& point) { return " at " + svg::short_number(100.0 * point.way, 1) + " %"; }

void draw_singular_value(svg::Svg& svg, const PathStatus& report) {
  double top = 0.0;
  for (const PathPoint& point : report.points) top = std::max(top, point.least_singular_value);
  const svg::Axes axes = plot(0, {0.0, top > 0.0 ? 1.15 * top : 1.0}, false);
  svg::draw_axes(svg, axes, "", "least singular value");
  draw_waypoints(svg, axes, report);
  const auto value = [](const PathPoint& point) { return point.least_singular_value; };
  draw_curve(svg, axes, report, value, {.stroke = kLineColour, .width = 2.0});
  const PathPoint& worst = report.points[report.worst_conditioned];
  mark_worst(svg, axes, worst, value(worst), "worst " + svg::short_number(value(worst), 3) + percent(worst));
}

void draw_condition(svg::Svg& svg, const PathStatus& report) {
  double low = 1e300, high = 0.0;
  for (const PathPoint& point : report.points) {
    const double value = condition_number(point);
    if (!std::isfinite(value)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const bool any = high > 0.0;
  const svg::Axes axes = plot(1, any ? svg::AxisRange{low / 1.3, high * 1.3} : svg::AxisRange{1.0, 10.0}, true);
  svg::draw_axes(svg, axes, "", "condition number");
  draw_waypoints(svg, axes, report);
  draw_curve(svg, axes, report, condition_number, {.stroke = kLineColour, .width = 2.0});
  if (!any)
    svg.text({kLeft_px + 10.0, kPlotTop_px[1] + 24.0}, "infinite all the way: some tip motion is not possible",
             {.colour = kWorstColour});
}

// Which theta is nearest to its limit, as a strip of coloured runs.
void draw_strip(svg::Svg& svg, const svg::Axes& axes, const PathStatus& report) {
  for (std::size_t first = 0; first < report.points.size();) {
    const std::int32_t theta = report.points[first].nearest_theta;
    std::size_t next = first;
    while (next < report.points.size() && report.points[next].nearest_theta == theta) ++next;
    const double last_way = next < report.points.size() ? report.points[next].way : 1.0;
    const svg::Pixel from = axes.at(100.0 * report.points[first].way, axes.y.low);
    const double width_px = axes.at(100.0 * last_way, 0.0).x - from.x;
    svg.rectangle({from.x, from.y - kStrip_px}, width_px, kStrip_px, {.fill = theta_colour(theta), .opacity = 0.85});
    if (width_px >= kLabelRoom_px) {
      svg.text({from.x + width_px / 2.0, from.y - 3.0}, "theta " + std::to_string(theta),
               {.size = 11.0, .anchor = "middle", .bold = true});
    }
    first = next;
  }
}

void draw_margins(svg::Svg& svg, const cable::RobotParams& table, const PathStatus& report, std::uint32_t held_mask) {
  double limit_deg = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i) {
    limit_deg = std::max(limit_deg, table.segment[i / 2].theta_limit_rad / kDegree);
  }
  const svg::Axes axes = plot(2, {-0.12 * limit_deg, 1.05 * limit_deg}, false);  // room for the strip below 0
  svg::draw_axes(svg, axes, "joint travel (% of the way), waypoints dashed", "margin to the limit (deg)");
  draw_waypoints(svg, axes, report);
  for (std::size_t i = 0; i < static_cast<std::size_t>(table.theta_count()); ++i) {
    if (held_mask >> i & 1u) continue;
    const auto margin_deg = [&](const PathPoint& point) {
      return (table.segment[i / 2].theta_limit_rad - std::fabs(point.theta_rad[i])) / kDegree;
    };
    const auto theta = static_cast<std::int32_t>(i + 1);
    draw_curve(svg, axes, report, margin_deg, {.stroke = theta_colour(theta), .width = 1.3, .opacity = 0.8});
  }
  const auto min_deg = [](const PathPoint& point) { return point.limit_margin_rad / kDegree; };
  draw_curve(svg, axes, report, min_deg, {.stroke = "#111111", .width = 2.4});
  draw_strip(svg, axes, report);
  const PathPoint& worst = report.points[report.nearest_limit];
  mark_worst(svg, axes, worst, min_deg(worst),
             "theta " + std::to_string(worst.nearest_theta) + ": " + svg::short_number(min_deg(worst), 2) +
                 " deg left" + percent(worst));
}

void draw_theta_legend(svg::Svg& svg, const cable::RobotParams& table, std::uint32_t held_mask) {
  double x = kLeft_px;
  const double y = kHeight_px - 16.0;
  for (std::int32_t theta = 1; theta <= table.theta_count(); ++theta) {
    if (held_mask >> (theta - 1) & 1) continue;
    svg.line({x, y - 4.0}, {x + 16.0, y - 4.0}, {.stroke = theta_colour(theta), .width = 3.0});
    svg.text({x + 20.0, y}, std::to_string(theta), {.size = 11.0});
    x += 46.0;
  }
  svg.line({x, y - 4.0}, {x + 16.0, y - 4.0}, {.stroke = "#111111", .width = 3.0});
  svg.text({x + 20.0, y}, "least of the free thetas; the strip says which one", {.size = 11.0});
}

std::string free_text(const cable::RobotParams& table, std::uint32_t held_mask) {
  std::string held;
  std::int32_t free = 0;
  for (std::int32_t i = 0; i < table.theta_count(); ++i) {
    if (held_mask >> i & 1) {
      held += (held.empty() ? "" : ", ") + std::to_string(i + 1);
    } else {
      ++free;
    }
  }
  return std::to_string(free) + " free thetas" + (held.empty() ? "" : " (held: " + held + ")");
}

}  // namespace

std::string path_picture(const config::RobotConfig& robot, const PathStatus& report, std::uint32_t held_mask) {
  const std::string title = "Conditioning and limits of " + robot.name + " along a path";
  svg::Svg svg(kWidth_px, kHeight_px, title);
  svg.text({30.0, 34.0}, title, {.size = 20.0, .bold = true});
  svg.text({30.0, 56.0}, free_text(robot.table, held_mask) + ", " + std::to_string(report.waypoint_way.size()) +
                             " waypoints, joint travel " + svg::short_number(report.joint_travel_rad / kDegree, 1) +
                             " deg");
  svg.text({30.0, 75.0}, "tip Jacobian, linear rows m/rad, angular rows rad/rad (weighed by 1 m)", {.size = 12.0});
  draw_singular_value(svg, report);
  draw_condition(svg, report);
  draw_margins(svg, robot.table, report, held_mask);
  draw_theta_legend(svg, robot.table, held_mask);
  return svg.document();
}

}  // namespace liana::workspace
