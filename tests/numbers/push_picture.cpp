#include "tests/numbers/push_picture.hpp"

#include <string_view>

#include "host/base/svg/axes.hpp"

namespace liana::numbers {
namespace {

using svg::Axes;
using svg::Pixel;
using svg::Svg;

constexpr double kWide = 900.0, kHigh = 700.0, kLeft = 80.0, kPlotWide = 780.0, kPlotHigh = 165.0, kDown = 210.0;
constexpr double kShown_s = 40.0;
constexpr std::string_view kSoftColour = "#1f65a3", kStiffColour = "#d62728", kSetColour = "#777777";
constexpr int kEvery = 10;  // instants, of which a curve shows one

Axes panel(int number, svg::AxisRange y) {
  return {{kLeft, 66.0 + kDown * number}, kPlotWide, kPlotHigh, {0.0, kShown_s}, y};
}

template <class Value>
void curve(Svg& svg, const Axes& axes, const std::vector<Instant>& course, std::string_view colour, bool dashed,
           const Value& value) {
  std::vector<Pixel> line;
  for (std::size_t i = 0; i < course.size() && course[i].time_s <= kShown_s; i += kEvery)
    line.push_back(axes.at(course[i].time_s, value(course[i])));
  svg.polyline(line, {.stroke = colour, .width = 1.8, .dashed = dashed});
}

}  // namespace

std::string push_picture(const std::vector<Instant>& soft, const std::vector<Instant>& stiff) {
  Svg svg(kWide, kHigh, "A push into the adapter on a soft and on a stiff base");
  svg.text({20.0, 28.0}, "A payload of 500 kg is pushed into its adapter, captured and let go",
           {.size = 17.0, .bold = true});
  svg.text({kLeft, 52.0}, "soft base", {.colour = kSoftColour, .bold = true});
  svg.text({kLeft + 90.0, 52.0}, "20 times as stiff", {.colour = kStiffColour, .bold = true});
  svg.text({kLeft + 230.0, 52.0}, "dashed: the force that is set", {.colour = kSetColour, .bold = true});
  const Axes force = panel(0, {-10.0, 40.0}), depth = panel(1, {-5.0, 25.0}), base = panel(2, {0.0, 10.0});
  svg::draw_axes(svg, force, "", "along the axis (N)");
  svg::draw_axes(svg, depth, "", "pins past the face (mm)");
  svg::draw_axes(svg, base, "time since the push was asked for (s)", "base gives way (mm)");
  for (const auto& [course, colour] : {std::pair{&soft, kSoftColour}, std::pair{&stiff, kStiffColour}}) {
    curve(svg, force, *course, kSetColour, true, [](const Instant& now) { return now.set_N; });
    curve(svg, force, *course, colour, false, [](const Instant& now) { return now.axial_N; });
    curve(svg, depth, *course, colour, false, [](const Instant& now) { return 1e3 * now.depth_m; });
    curve(svg, base, *course, colour, false, [](const Instant& now) { return 1e3 * now.base_m; });
  }
  return svg.document();
}

}  // namespace liana::numbers
