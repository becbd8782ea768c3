// One diagram in a picture: where values lie, and axes with ticks.
#pragma once

#include <string_view>
#include <vector>

#include "host/base/svg/svg.hpp"

namespace liana::svg {

// A range of values, low < high.
struct AxisRange {
  double low = 0.0;
  double high = 1.0;
};

// A rectangle of the picture showing `x` to the right and `y` upwards; logarithmic y needs y.low > 0.
struct Axes {
  Pixel corner;  // upper left
  double width = 0.0;
  double height = 0.0;
  AxisRange x;
  AxisRange y;
  bool log_y = false;

  // Where a value stands; values outside the range stand outside the rectangle.
  Pixel at(double x_value, double y_value) const;
};

// Places for about `count` ticks at 1, 2 or 5 times a power of ten, inside the range, rising.
std::vector<double> ticks(const AxisRange& range, int count);
// Powers of ten inside a range of positive values; where there are fewer than three, 2 and 5 times them too, or evenly
// spaced places.
std::vector<double> log_ticks(const AxisRange& range);

// Grid lines, tick labels and titles at the left and lower edges.
void draw_axes(Svg& svg, const Axes& axes, std::string_view x_title, std::string_view y_title);

}  // namespace liana::svg
