// What chance makes of a budget: the same errors drawn again and again, as vectors (requirement B8).
#pragma once

#include <cstdint>

#include "host/planning/error_budget/budget.hpp"

namespace liana::error_budget {

constexpr std::int64_t kMinDraws = 100, kMaxDraws = 10'000'000;
// A stated error is this many standard deviations of each axis: with 2, what the sources call 142 mm is what 95 % of
// all tries stay under.
constexpr double kSigmas = 2.0;

// How far beside the goal, across the chain's direction [m].
struct Spread {
  double median_m = 0.0, p95_m = 0.0, worst_m = 0.0;
  double within_formula = 0.0;  // share of draws that stay within readings_of(loop).terms, 0 to 1
};

// `draws` within kMinDraws..kMaxDraws. Every error is three positions and three small rotations, normal, drawn once
// per try: terms that share an error share its draw. The chain points along x; what counts lies in y and z. Same seed,
// same result on every machine whose std::log and std::cos round alike. Cost: about 0.3 us per error and draw.
Spread draw(const config::ErrorLoop& loop, std::int64_t draws, std::uint64_t seed);

}  // namespace liana::error_budget
