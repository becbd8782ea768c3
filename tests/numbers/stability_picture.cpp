#include "tests/numbers/stability_picture.hpp"

#include <algorithm>
#include <string_view>

#include "host/base/svg/svg.hpp"

namespace liana::numbers {
namespace {

using svg::Pixel;
using svg::Svg;

constexpr double kSquare = 8.0, kGap = 5.0;
constexpr double kPlaceWide = 4.0 * kSquare + kGap, kPlaceHigh = 2.0 * kSquare + kGap;
constexpr double kPanelWide = 6.0 * kPlaceWide, kPanelHigh = 4.0 * kPlaceHigh;
constexpr double kLeft = 150.0, kTop = 70.0, kAcross = kPanelWide + 30.0, kDown = kPanelHigh + 45.0;
constexpr std::string_view kStable = "#3a9d5d", kActive = "#e8a33d", kMoving = "#c0392b";

template <class Values>
double place(const Values& values, double value) {
  return static_cast<double>(std::find(values.begin(), values.end(), value) - values.begin());
}

Pixel corner_of(haptics::Law law, Layer layer) {
  return {kLeft + kAcross * static_cast<double>(layer), kTop + kDown * static_cast<double>(law)};
}

// Left end and middle of a cell's square.
Pixel square_of(const Judged& judged) {
  const Cell& cell = judged.cell;
  const Pixel corner = corner_of(judged.law, judged.layer);
  return {corner.x + kPlaceWide * place(kDelays_s, cell.delay_s) + kSquare * place(kWalls_N_m, cell.wall_N_m),
          corner.y + kPlaceHigh * (3.0 - place(kHands_N_m, cell.hand_N_m)) +
              kSquare * (1.5 - place(kMasses_kg, cell.hand_kg))};
}

std::string_view colour_of(const Verdict& verdict) {
  if (verdict.moving()) return kMoving;
  return verdict.active() ? kActive : kStable;
}

void draw_labels(Svg& svg) {
  for (std::size_t layer = 0; layer < kLayerNames.size(); ++layer) {
    const double x = kLeft + kAcross * static_cast<double>(layer) + kPanelWide / 2.0;
    svg.text({x, kTop - 12.0}, layer == 0 ? "no layer" : kLayerNames[layer],
             {.size = 14.0, .anchor = "middle", .bold = true});
    svg.text({x, kTop + 3.0 * kDown - 8.0}, "delay there and back (s)", {.size = 12.0, .anchor = "middle"});
  }
  for (std::size_t law = 0; law < haptics::kLawNames.size(); ++law) {
    const double y = kTop + kDown * static_cast<double>(law);
    svg.text({14.0, y + kPanelHigh / 2.0}, haptics::kLawNames[law], {.size = 14.0, .bold = true});
    svg.text({92.0, y + kPanelHigh / 2.0}, "hand (N/m)", {.size = 11.0, .anchor = "middle", .upwards = true});
    for (const double hand : kHands_N_m)
      svg.text({kLeft - 8.0, y + kPlaceHigh * (3.4 - place(kHands_N_m, hand)) + 5.0}, svg::short_number(hand, 0),
               {.size = 11.0, .anchor = "end"});
    for (std::size_t layer = 0; layer < kLayerNames.size(); ++layer)
      for (const double delay : kDelays_s)
        svg.text({kLeft + kAcross * static_cast<double>(layer) + kPlaceWide * place(kDelays_s, delay) + 2.0 * kSquare,
                  y + kPanelHigh + 10.0},
                 svg::short_number(delay, 1), {.size = 11.0, .anchor = "middle"});
  }
}

void draw_legend(Svg& svg) {
  double x = kLeft;
  const double y = kTop + 3.0 * kDown + 18.0;
  for (const auto& [colour, words] :
       {std::pair{kStable, "at rest, never gave more than 0.1 J"},
        std::pair{kActive, "at rest in the end, gave more than 0.1 J"}, std::pair{kMoving, "still moving"}}) {
    svg.rectangle({x, y - 10.0}, 12.0, 12.0, {.fill = colour, .stroke = "none"});
    svg.text({x + 18.0, y}, words, {.size = 12.0});
    x += 270.0;
  }
  svg.text({kLeft, y + 22.0},
           "In each place: walls of 0 (none), 500, 5000, 20000 N/m from left to right; a hand of 0.5 kg below, of 2 kg "
           "above.",
           {.size = 12.0});
}

}  // namespace

std::string stability_picture(const std::vector<Judged>& map) {
  Svg svg(kLeft + 3.0 * kAcross, kTop + 3.0 * kDown + 60.0, "Stability of force feedback under delay");
  svg.text({14.0, 26.0}, "Force feedback under delay: every law, with and without a passivity layer",
           {.size = 16.0, .bold = true});
  for (const std::string_view colour : {kStable, kActive, kMoving}) {
    std::vector<Svg::Bar> bars;
    for (const Judged& judged : map) {
      if (colour_of(judged.verdict) == colour) bars.push_back({square_of(judged), kSquare - 1.0});
    }
    svg.bars(bars, kSquare - 1.0, colour);
  }
  draw_labels(svg);
  draw_legend(svg);
  return svg.document();
}

}  // namespace liana::numbers
