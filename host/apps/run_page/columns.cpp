#include "host/apps/run_page/columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "host/apps/run_page/deflate.hpp"
#include "host/base/json/json.hpp"

namespace liana::run_page {
namespace {

constexpr double kMaxCell = 32767.0;

double finest(std::string_view unit) {
  static constexpr std::array<std::pair<std::string_view, double>, 7> kFinest{
      {{"deg", 1e-3}, {"m", 1e-4}, {"m, 1", 1e-4}, {"N", 0.1}, {"Nm", 0.01}, {"m/s", 1e-5}, {"s", 1e-3}}};
  for (const auto& [name, step] : kFinest) {
    if (name == unit) return step;
  }
  return 1e-3;
}

double scale_for(std::string_view unit, const std::vector<double>& values) {
  double most = 0.0;
  for (const double value : values) {
    if (std::isfinite(value)) most = std::max(most, std::fabs(value));
  }
  double scale = finest(unit);
  while (most > kMaxCell * scale) scale *= 10.0;
  return scale;
}

}  // namespace

Column column_of(const std::string& name, std::size_t index, const std::string& unit,
                 const std::vector<double>& values) {
  Column column{name, index, unit, scale_for(unit, values), {}};
  column.cells.reserve(values.size());
  for (const double value : values) {
    column.cells.push_back(std::isfinite(value) ? static_cast<std::int16_t>(std::lround(value / column.scale))
                                                : kNotThere);
  }
  return column;
}

Json to_json(const Column& column) {
  return {{"name", column.name}, {"index", column.index}, {"unit", column.unit}, {"scale", column.scale}};
}

std::string packed(const std::vector<Column>& columns) {
  std::string bytes;
  for (const Column& column : columns) {
    std::string high;
    std::uint16_t before = 0;
    for (const std::int16_t cell : column.cells) {
      const auto now = static_cast<std::uint16_t>(cell);
      const auto step = static_cast<std::uint16_t>(now - before);
      bytes.push_back(static_cast<char>(step & 0xFFu));
      high.push_back(static_cast<char>(step >> 8));
      before = now;
    }
    bytes += high;
  }
  return base64(deflated(bytes));
}

}  // namespace liana::run_page
