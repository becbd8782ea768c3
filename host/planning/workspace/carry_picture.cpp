#include <algorithm>
#include <map>

#include "host/base/svg/axes.hpp"
#include "host/planning/workspace/carry.hpp"

namespace liana::workspace {
namespace {

using Index = std::size_t;

constexpr double kPanel_px = 300.0, kPanelGap_px = 70.0, kPanelsLeft_px = 70.0, kPanelsTop_px = 110.0;
constexpr double kPlace_px = 8.0;  // of a cell
constexpr Index kColumns = 3;
constexpr std::array<std::string_view, kTensionBands> kBandColours{"#7fb8de", "#ffd92f", "#fc8d62", "#a50f15"};

// Coordinate to the right and upwards: gravity is in the picture where the arm lies.
std::pair<Index, Index> sides_of(const Vec3& gravity_m_s2) {
  const bool along_y = gravity_m_s2[1] * gravity_m_s2[1] > gravity_m_s2[2] * gravity_m_s2[2];
  return {0, along_y ? 1 : 2};
}

void draw_panel(svg::Svg& svg, svg::Pixel corner, const Carried& carried, double length_m) {
  constexpr std::array kTitles{"x (m)", "y (m)", "z (m)"};
  const auto [right, up] = sides_of(carried.mounting.gravity_m_s2);
  const svg::AxisRange range{-1.05 * length_m, 1.05 * length_m};
  const svg::Axes axes{corner, kPanel_px, kPanel_px, range, range};
  svg::draw_axes(svg, axes, kTitles[right], kTitles[up]);
  std::map<std::pair<int, int>, TensionBand> cells;
  for (const CarriedPose& pose : carried.poses) {
    const svg::Pixel at = axes.at(pose.tip_in_base_m[right], pose.tip_in_base_m[up]);
    TensionBand& band = cells[{static_cast<int>(at.x / kPlace_px), static_cast<int>(at.y / kPlace_px)}];
    band = std::max(band, pose.band);
  }
  for (const auto& [cell, band] : cells)
    svg.rectangle({kPlace_px * cell.first, kPlace_px * cell.second}, kPlace_px, kPlace_px,
                  {.fill = kBandColours[static_cast<Index>(band)]});
  const svg::Pixel base = axes.at(0.0, 0.0);
  svg.rectangle({base.x - 4.0, base.y - 4.0}, 8.0, 8.0, {.fill = "#222222"});
  svg.text({corner.x, corner.y - 10.0}, carried.mounting.name, {.size = 13.0, .bold = true});
}

}  // namespace

std::string carry_picture(const config::RobotConfig& robot, const std::vector<Carried>& carried) {
  double length_m = 0.0;
  for (Index j = 0; j < static_cast<Index>(robot.table.segment_count); ++j)
    length_m += robot.table.segment[j].modules * robot.table.segment[j].module_length_m;
  const Index rows = (carried.size() + kColumns - 1) / kColumns;
  const std::string title = "Where the tip of " + robot.name + " can be, and what its cables pull there";
  svg::Svg svg(kPanelsLeft_px + kColumns * (kPanel_px + kPanelGap_px),
               kPanelsTop_px + static_cast<double>(rows) * (kPanel_px + kPanelGap_px), title);
  svg.text({30.0, 34.0}, title, {.size = 20.0, .bold = true});
  constexpr std::array kNames{"up to the ceiling", "over the ceiling", "over the alarm", "over the limit, or slack"};
  double x = 30.0;
  for (Index i = 0; i < kTensionBands; ++i, x += 200.0) {
    svg.rectangle({x, 50.0}, 26.0, 13.0, {.fill = kBandColours[i]});
    svg.text({x + 34.0, 61.0}, kNames[i], {.size = 12.0});
  }
  svg.text({30.0, 82.0}, "the worst of the drawn poses in each cell, over the whole depth; black: the base",
           {.size = 12.0});
  for (Index i = 0; i < carried.size(); ++i) {
    const auto column = static_cast<double>(i % kColumns), row = static_cast<double>(i / kColumns);
    draw_panel(svg,
               {kPanelsLeft_px + column * (kPanel_px + kPanelGap_px), kPanelsTop_px + row * (kPanel_px + kPanelGap_px)},
               carried[i], length_m);
  }
  return svg.document();
}

}  // namespace liana::workspace
