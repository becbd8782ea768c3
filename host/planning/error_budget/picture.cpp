#include "host/planning/error_budget/picture.hpp"

#include <algorithm>

#include "host/base/svg/svg.hpp"

namespace liana::error_budget {
namespace {

constexpr double kWidth_px = 900.0, kBarsFrom_px = 300.0, kBarsWidth_px = 500.0;
constexpr double kRow_px = 30.0, kHead_px = 80.0, kBetween_px = 44.0, kFoot_px = 24.0;
constexpr std::string_view kTermColour = "#1f65a3", kSumColour = "#222222", kChanceColour = "#d62728";

std::string millimetres(double value_m) { return svg::short_number(1e3 * value_m, 1) + " mm"; }

// Draws rows one below the other; every loop has a scale of its own, because one is a tenth of the other.
class Rows {
 public:
  Rows(svg::Svg& svg, double top_px) : svg_(svg), y_px_(top_px) {}

  void loop(std::string_view title, const config::ErrorLoop& loop, const Spread& spread) {
    const double formula_m = readings_of(loop).terms;
    double most_m = std::max(formula_m, spread.p95_m);
    for (const config::ErrorTerm& term : loop.terms) most_m = std::max(most_m, size_m(loop, term));
    px_per_m_ = most_m > 0.0 ? kBarsWidth_px / most_m : 0.0;
    svg_.text({20.0, y_px_}, title, {.size = 15.0, .bold = true});
    y_px_ += kRow_px;
    for (const config::ErrorTerm& term : loop.terms) bar(term.name, size_m(loop, term), kTermColour);
    bar("root of the sum of squares", formula_m, kSumColour);
    bar("95 % of all draws stay within", spread.p95_m, kChanceColour);
    y_px_ += kBetween_px - kRow_px + 10.0;
  }

 private:
  void bar(std::string_view name, double value_m, std::string_view colour) {
    const double width_px = value_m * px_per_m_;
    svg_.text({kBarsFrom_px - 12.0, y_px_ + 5.0}, name, {.anchor = "end"});
    svg_.rectangle({kBarsFrom_px, y_px_ - 9.0}, width_px, 18.0, {.fill = colour});
    svg_.text({kBarsFrom_px + width_px + 8.0, y_px_ + 5.0}, millimetres(value_m));
    y_px_ += kRow_px;
  }

  svg::Svg& svg_;
  double y_px_;
  double px_per_m_ = 0.0;
};

}  // namespace

std::string picture_of(const config::ErrorBudget& budget, const Spread& open_loop, const Spread& closed_loop) {
  const auto rows = static_cast<double>(budget.open_loop.terms.size() + budget.closed_loop.terms.size() + 6);
  svg::Svg svg(kWidth_px, kHead_px + rows * kRow_px + 2.0 * kBetween_px + kFoot_px - kRow_px,
               "Error budget " + budget.name);
  svg.text({20.0, 32.0}, "Error budget " + budget.name, {.size = 18.0, .bold = true});
  Rows drawn(svg, kHead_px);
  drawn.loop("open loop", budget.open_loop, open_loop);
  drawn.loop("led by the camera", budget.closed_loop, closed_loop);
  return svg.document();
}

}  // namespace liana::error_budget
