#include "host/apps/campaign/picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string_view>

#include "host/apps/campaign/statistics.hpp"
#include "host/base/svg/axes.hpp"
#include "host/base/svg/svg.hpp"

namespace liana::campaign {
namespace {

constexpr double kWidth_px = 960.0, kHead_px = 78.0, kRow_px = 26.0;
constexpr double kNames_px = 190.0, kShares_px = 560.0;
constexpr double kPlotWidth_px = 380.0, kPlotHeight_px = 200.0, kCellWidth_px = 470.0, kCellHeight_px = 280.0;
constexpr std::size_t kMaxSteps = 400;  // of one curve: more is not seen
constexpr std::array<std::string_view, 2> kColours{"#1f65a3", "#d62728"};

std::string_view colour_of(std::size_t campaign) { return kColours[campaign % kColours.size()]; }

std::string percent(double share) { return svg::short_number(100.0 * share, 1); }

void draw_legend(svg::Svg& svg, const std::vector<Stored>& campaigns) {
  double x_px = 20.0;
  for (std::size_t i = 0; i < campaigns.size(); ++i) {
    const Stored& each = campaigns[i];
    svg.rectangle({x_px, 48.0}, 14.0, 14.0, {.fill = colour_of(i)});
    const std::string words = each.campaign.name + ", " + std::to_string(each.rows.size()) + " of " +
                              std::to_string(each.campaign.rows) + " rows";
    svg.text({x_px + 20.0, 60.0}, words);
    x_px += 460.0;
  }
}

// A bar for each outcome of each campaign, with the interval as a line over its end; returns where it ends below.
double draw_shares(svg::Svg& svg, const std::vector<Stored>& campaigns, double y_px) {
  std::set<std::string> outcomes;
  std::vector<std::map<std::string, Share>> shares;
  for (const Stored& each : campaigns) {
    shares.push_back(outcome_shares(each.rows));
    for (const auto& [outcome, share] : shares.back()) outcomes.insert(outcome);
  }
  for (const std::string& outcome : outcomes) {
    for (std::size_t i = 0; i < campaigns.size(); ++i) {
      const auto found = shares[i].find(outcome);
      const Share share = found != shares[i].end() ? found->second : exact_share(0, campaigns[i].rows.size());
      const double middle_px = y_px + 0.5 * kRow_px;
      if (i == 0) svg.text({kNames_px - 12.0, middle_px + 5.0}, outcome, {.anchor = "end"});
      svg.rectangle({kNames_px, middle_px - 8.0}, kShares_px * share.value(), 16.0,
                    {.fill = colour_of(i), .opacity = 0.6});
      svg.line({kNames_px + kShares_px * share.low, middle_px}, {kNames_px + kShares_px * share.high, middle_px},
               {.stroke = "#222222", .width = 2.0});
      svg.text({kNames_px + kShares_px + 12.0, middle_px + 5.0},
               percent(share.value()) + " % (" + percent(share.low) + " to " + percent(share.high) + ")");
      y_px += kRow_px;
    }
  }
  return y_px;
}

svg::AxisRange range_of(const std::vector<std::vector<double>>& all) {
  svg::AxisRange range{0.0, 0.0};
  bool is_first = true;
  for (const std::vector<double>& values : all) {
    if (values.empty()) continue;
    range.low = is_first ? values.front() : std::min(range.low, values.front());
    range.high = is_first ? values.back() : std::max(range.high, values.back());
    is_first = false;
  }
  const double width = range.high - range.low;
  const double of_one = range.high == 0.0 ? 1.0 : 0.05 * std::fabs(range.high);  // all values are the same
  const double beside = width > 0.0 ? 0.03 * width : of_one;
  return {range.low - beside, range.high + beside};
}

void draw_spread(svg::Svg& svg, const std::vector<Stored>& campaigns, const std::string& figure, svg::Pixel corner) {
  std::vector<std::vector<double>> all;
  for (const Stored& each : campaigns) {
    all.push_back(values_of(each.rows, figure));
    std::sort(all.back().begin(), all.back().end());
  }
  const svg::Axes axes{corner, kPlotWidth_px, kPlotHeight_px, range_of(all), {0.0, 1.0}};
  svg::draw_axes(svg, axes, figure, "share of rows below");
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::vector<double>& values = all[i];
    if (values.empty()) continue;
    const auto count = static_cast<double>(values.size());
    const std::size_t stride = std::max<std::size_t>(1, values.size() / kMaxSteps);
    std::vector<svg::Pixel> points{axes.at(values.front(), 0.0)};
    for (std::size_t k = 0; k < values.size(); k += stride) {
      points.push_back({axes.at(values[k], 0.0).x, points.back().y});
      points.push_back(axes.at(values[k], static_cast<double>(k + 1) / count));
    }
    points.push_back(axes.at(values.back(), 1.0));
    svg.polyline(points, {.stroke = colour_of(i), .width = 2.0, .dashed = i > 0});
  }
}

}  // namespace

std::string picture_of(const std::vector<Stored>& campaigns, const std::vector<std::string>& figures) {
  std::set<std::string> outcomes;
  for (const Stored& each : campaigns) {
    for (const auto& [outcome, share] : outcome_shares(each.rows)) outcomes.insert(outcome);
  }
  const double shares_px = kRow_px * static_cast<double>(outcomes.size() * campaigns.size());
  const double plots_px = kCellHeight_px * std::ceil(static_cast<double>(figures.size()) / 2.0);
  const std::string title = "Campaign " + campaigns.front().campaign.name;
  svg::Svg svg(kWidth_px, kHead_px + shares_px + plots_px + 40.0, title);
  svg.text({20.0, 32.0}, title, {.size = 18.0, .bold = true});
  draw_legend(svg, campaigns);
  const double below_px = draw_shares(svg, campaigns, kHead_px) + 30.0;
  for (std::size_t i = 0; i < figures.size(); ++i)
    draw_spread(
        svg, campaigns, figures[i],
        {70.0 + kCellWidth_px * static_cast<double>(i % 2), below_px + kCellHeight_px * static_cast<double>(i / 2)});
  return svg.document();
}

}  // namespace liana::campaign
