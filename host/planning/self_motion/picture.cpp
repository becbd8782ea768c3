#include "host/planning/self_motion/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "firmware_like/math/trig.hpp"
#include "host/base/svg/axes.hpp"

namespace liana::self_motion {
namespace {

constexpr double kWidth_px = 900.0, kHeight_px = 480.0;
constexpr double kLeft_px = 80.0, kTop_px = 70.0, kPlotWidth_px = 780.0, kPlotHeight_px = 340.0;
constexpr std::array<std::string_view, 3> kColours{"#2ca02c", "#ff7f0e", "#1f65a3"};
constexpr std::array<std::string_view, 3> kNames{"force along x", "force along y",
                                                 "force along z, the axis of insertion"};
constexpr std::array<double, 3> kLegend_px{0.0, 110.0, 220.0};
constexpr double kMinAdvance_px = 0.7;

double millimetres(const Configuration& at, std::size_t axis) { return 1e3 * std::fabs(at.deflection_m_per_N[axis]); }
double degrees(const Configuration& at) { return at.arm_angle_rad / kDegree; }

void mark(svg::Svg& svg, const svg::Axes& axes, const Configuration& at, std::string_view name) {
  const svg::Pixel place = axes.at(degrees(at), millimetres(at, 2));
  const bool right_half = place.x > kLeft_px + 0.5 * kPlotWidth_px;
  svg.circle(place, 5.0, {.stroke = "#d62728", .width = 2.0});
  svg.text({place.x + (right_half ? -10.0 : 10.0), place.y - 8.0},
           std::string(name) + " " + svg::short_number(millimetres(at, 2), 2) + " mm/N",
           {.size = 12.0, .anchor = right_half ? "end" : "start", .colour = "#d62728", .bold = true, .halo = true});
}

void curve(svg::Svg& svg, const svg::Axes& axes, const SelfMotion& motion, std::size_t axis) {
  std::vector<svg::Pixel> line;
  for (const Configuration& at : motion.way) {
    const svg::Pixel place = axes.at(degrees(at), millimetres(at, axis));
    const bool is_last = &at == &motion.way.back();
    const bool far =
        line.empty() || std::abs(place.x - line.back().x) + std::abs(place.y - line.back().y) > kMinAdvance_px;
    if (far || is_last) line.push_back(place);
  }
  svg.polyline(line, {.stroke = kColours[axis], .width = 2.0});
}

bool gives_way_less(const Configuration& a, const Configuration& b) {
  return dot(a.deflection_m_per_N, a.deflection_m_per_N) < dot(b.deflection_m_per_N, b.deflection_m_per_N);
}

}  // namespace

std::size_t stiffest(const SelfMotion& motion) {
  const auto found = std::min_element(motion.way.begin(), motion.way.end(), gives_way_less);
  return static_cast<std::size_t>(found - motion.way.begin());
}

std::size_t softest(const SelfMotion& motion) {
  const auto found = std::max_element(motion.way.begin(), motion.way.end(), gives_way_less);
  return static_cast<std::size_t>(found - motion.way.begin());
}

std::string picture_of(const std::string& robot, const SelfMotion& motion) {
  double most = 0.0, low = 0.0, high = 0.0;
  for (const Configuration& at : motion.way) {
    for (std::size_t axis = 0; axis < 3; ++axis) most = std::max(most, millimetres(at, axis));
    low = std::min(low, degrees(at));
    high = std::max(high, degrees(at));
  }
  svg::Svg svg(kWidth_px, kHeight_px, "Deflection of " + robot + " along its self-motion");
  svg.text({20.0, 30.0}, "Deflection of " + robot + " under 1 N along the tip's z axis, the tip still",
           {.size = 17.0, .bold = true});
  const svg::Axes axes{{kLeft_px, kTop_px},
                       kPlotWidth_px,
                       kPlotHeight_px,
                       {low, std::max(high, low + 1.0)},
                       {0.0, most > 0.0 ? 1.1 * most : 1.0}};
  svg::draw_axes(svg, axes, "arm angle (deg)", "deflection (mm)");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    curve(svg, axes, motion, axis);
    svg.text({kLeft_px + kLegend_px[axis], 54.0}, kNames[axis], {.colour = kColours[axis], .bold = true});
  }
  mark(svg, axes, motion.way[stiffest(motion)], "stiffest");
  mark(svg, axes, motion.way[softest(motion)], "softest");
  return svg.document();
}

}  // namespace liana::self_motion
