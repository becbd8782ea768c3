#include "host/base/svg/axes.hpp"

#include <algorithm>
#include <cmath>

namespace liana::svg {
namespace {

constexpr Look kGrid{.stroke = "#dddddd", .width = 0.7};
constexpr Look kFrame{.stroke = "#555555", .width = 1.0};

double share(const AxisRange& range, double value, bool logarithmic) {
  if (logarithmic) return std::log(value / range.low) / std::log(range.high / range.low);
  return (value - range.low) / (range.high - range.low);
}

// Decimals that a tick step needs.
int decimals_for(double step) { return std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 9); }

std::vector<double> powers_times(const AxisRange& range, const std::vector<double>& factors) {
  std::vector<double> places;
  const int last = static_cast<int>(std::ceil(std::log10(range.high)));
  for (int exponent = static_cast<int>(std::floor(std::log10(range.low))); exponent <= last; ++exponent) {
    for (const double factor : factors) {
      const double place = factor * std::pow(10.0, exponent);
      if (place >= range.low * (1.0 - 1e-9) && place <= range.high * (1.0 + 1e-9)) places.push_back(place);
    }
  }
  return places;
}

}  // namespace

Pixel Axes::at(double x_value, double y_value) const {
  return {corner.x + width * share(x, x_value, false), corner.y + height * (1.0 - share(y, y_value, log_y))};
}

std::vector<double> ticks(const AxisRange& range, int count) {
  const double rough = (range.high - range.low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) step = factor * power;
  }
  std::vector<double> places;
  for (double i = std::ceil(range.low / step - 1e-9); i * step <= range.high + 1e-9 * step; i += 1.0)
    places.push_back(i * step);
  return places;
}

std::vector<double> log_ticks(const AxisRange& range) {
  const auto powers = powers_times(range, {1.0});
  if (powers.size() >= 3) return powers;
  const auto more = powers_times(range, {1.0, 2.0, 5.0});
  return more.size() >= 3 ? more : ticks(range, 6);
}

void draw_axes(Svg& svg, const Axes& axes, std::string_view x_title, std::string_view y_title) {
  const double left = axes.corner.x, bottom = axes.corner.y + axes.height;
  const auto x_ticks = ticks(axes.x, std::max(2, static_cast<int>(axes.width / 60.0)));
  const auto y_ticks =
      axes.log_y ? log_ticks(axes.y) : ticks(axes.y, std::max(2, static_cast<int>(axes.height / 45.0)));
  for (const double x : x_ticks) {
    const Pixel foot = axes.at(x, axes.y.low);
    svg.line(foot, {foot.x, axes.corner.y}, kGrid);
    const int decimals = x_ticks.size() < 2 ? 2 : decimals_for(x_ticks[1] - x_ticks[0]);
    svg.text({foot.x, bottom + 16.0}, short_number(x, decimals), {.size = 11.0, .anchor = "middle"});
  }
  for (const double y : y_ticks) {
    const Pixel foot = axes.at(axes.x.low, y);
    svg.line(foot, {left + axes.width, foot.y}, kGrid);
    const int decimals = axes.log_y ? decimals_for(y) : y_ticks.size() < 2 ? 2 : decimals_for(y_ticks[1] - y_ticks[0]);
    svg.text({left - 6.0, foot.y + 4.0}, short_number(y, decimals), {.size = 11.0, .anchor = "end"});
  }
  svg.rectangle(axes.corner, axes.width, axes.height, kFrame);
  svg.text({left + axes.width / 2.0, bottom + 34.0}, x_title, {.size = 12.0, .anchor = "middle"});
  svg.text({left - 40.0, axes.corner.y + axes.height / 2.0}, y_title,
           {.size = 12.0, .anchor = "middle", .upwards = true});
}

}  // namespace liana::svg
