// An error budget by formula: how far beside its goal a chain of arms puts what it carries (requirements B7 to B9). By
// chance: monte_carlo.hpp.
#pragma once

#include "host/model/config/error_budget.hpp"

namespace liana::error_budget {

// The most a term can come to [m], all its errors the same way: sum of positions + lever sin(sum of angles).
double size_m(const config::ErrorLoop& loop, const config::ErrorTerm& term);

// Other ways to add up the same errors, for papers that do not say which they mean. All in metres.
struct Readings {
  double terms = 0.0;        // root of the sum of squares over terms: the figure of the budget
  double sum = 0.0;          // of all positions and all lever sin(angle of a term): nothing helps anything
  double apart = 0.0;        // root of the squares of these: nothing hangs together
  double independent = 0.0;  // root of squares of positions, plus that of levers whose angles add up as squares
};
Readings readings_of(const config::ErrorLoop& loop);

}  // namespace liana::error_budget
