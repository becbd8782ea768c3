// The contributions to an error budget as a picture.
#pragma once

#include <string>

#include "host/planning/error_budget/budget.hpp"
#include "host/planning/error_budget/monte_carlo.hpp"

namespace liana::error_budget {

// SVG text: a bar for every term of both loops, and for each loop what the formula and chance make of them.
std::string picture_of(const config::ErrorBudget& budget, const Spread& open_loop, const Spread& closed_loop);

}  // namespace liana::error_budget
