#include "host/planning/error_budget/monte_carlo.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "host/base/random/random.hpp"

namespace liana::error_budget {
namespace {

constexpr std::uint64_t kPurpose = 0xB0D6E7;

// One error as it happens to be, across the chain: what lies along it moves nothing sideways.
struct Drawn {
  double y_m = 0.0, z_m = 0.0;
  double about_y_rad = 0.0, about_z_rad = 0.0;
};

void draw_errors(const config::ErrorLoop& loop, simulated::RandomStream& random, std::vector<Drawn>& drawn) {
  for (std::size_t i = 0; i < loop.errors.size(); ++i) {
    const double position_m = loop.errors[i].position_m / kSigmas, angle_rad = loop.errors[i].angle_rad / kSigmas;
    drawn[i].y_m = random.normal(position_m);
    drawn[i].z_m = random.normal(position_m);
    drawn[i].about_y_rad = random.normal(angle_rad);
    drawn[i].about_z_rad = random.normal(angle_rad);
  }
}

double beside_m(const config::ErrorLoop& loop, const std::vector<Drawn>& drawn) {
  double y_m = 0.0, z_m = 0.0;
  for (const config::ErrorTerm& term : loop.terms) {
    double about_y_rad = 0.0, about_z_rad = 0.0;
    for (const std::size_t i : term.positions) {
      y_m += drawn[i].y_m;
      z_m += drawn[i].z_m;
    }
    for (const std::size_t i : term.angles) {
      about_y_rad += drawn[i].about_y_rad;
      about_z_rad += drawn[i].about_z_rad;
    }
    y_m += term.lever_m * std::sin(about_z_rad);
    z_m -= term.lever_m * std::sin(about_y_rad);
  }
  return std::hypot(y_m, z_m);
}

}  // namespace

Spread draw(const config::ErrorLoop& loop, std::int64_t draws, std::uint64_t seed) {
  simulated::RandomStream random(seed, kPurpose);
  std::vector<Drawn> drawn(loop.errors.size());
  std::vector<double> beside(static_cast<std::size_t>(draws));
  for (double& each : beside) {
    draw_errors(loop, random, drawn);
    each = beside_m(loop, drawn);
  }
  std::sort(beside.begin(), beside.end());
  const auto share = [&](double part) {
    return beside[static_cast<std::size_t>(part * static_cast<double>(draws - 1))];
  };
  const auto within = std::upper_bound(beside.begin(), beside.end(), readings_of(loop).terms) - beside.begin();
  return {share(0.5), share(0.95), beside.back(), static_cast<double>(within) / static_cast<double>(draws)};
}

}  // namespace liana::error_budget
