#include "host/planning/error_budget/budget.hpp"

#include <algorithm>
#include <cmath>

#include "firmware_like/math/trig.hpp"

namespace liana::error_budget {
namespace {

double position_m(const config::ErrorLoop& loop, const config::ErrorTerm& term) {
  double sum = 0.0;
  for (const std::size_t i : term.positions) sum += loop.errors[i].position_m;
  return sum;
}

double swing_m(const config::ErrorLoop& loop, const config::ErrorTerm& term) {
  double angle_rad = 0.0;
  for (const std::size_t i : term.angles) angle_rad += loop.errors[i].angle_rad;
  return term.lever_m * std::sin(std::min(angle_rad, 0.5 * kPi));
}

// With angles that have nothing to do with one another.
double independent_swing_m(const config::ErrorLoop& loop, const config::ErrorTerm& term) {
  double square = 0.0;
  for (const std::size_t i : term.angles) square += loop.errors[i].angle_rad * loop.errors[i].angle_rad;
  return term.lever_m * std::sin(std::min(std::sqrt(square), 0.5 * kPi));
}

}  // namespace

double size_m(const config::ErrorLoop& loop, const config::ErrorTerm& term) {
  return position_m(loop, term) + swing_m(loop, term);
}

Readings readings_of(const config::ErrorLoop& loop) {
  Readings found;
  double terms = 0.0, apart = 0.0, positions = 0.0, swings = 0.0;
  for (const config::ErrorTerm& term : loop.terms) {
    const double size = size_m(loop, term), swing = swing_m(loop, term), free = independent_swing_m(loop, term);
    terms += size * size;
    found.sum += size;
    apart += swing * swing;
    swings += free * free;
    for (const std::size_t i : term.positions) positions += loop.errors[i].position_m * loop.errors[i].position_m;
  }
  found.terms = std::sqrt(terms);
  found.apart = std::sqrt(apart + positions);
  found.independent = std::sqrt(positions) + std::sqrt(swings);
  return found;
}

}  // namespace liana::error_budget
