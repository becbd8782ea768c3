#include "hil/arm/start_tension.hpp"

#include <algorithm>
#include <stdexcept>

namespace liana::bench {

namespace {

// All angles, and the first that cables move: what moves a base carries its weight by itself.
struct Thetas {
  std::size_t first;
  std::size_t count;
};

// t := t - J (J^T J)^-1 (J^T t + w)
void project(const CableJacobian& jacobian, std::size_t cables, Thetas thetas, const Theta& weight_Nm,
             CableValues& tension) {
  ThetaMatrix gram{};
  Theta torque = weight_Nm;
  for (std::size_t a = 0; a < thetas.first; ++a) torque[a] = 0.0, gram[a][a] = 1.0;
  for (std::size_t c = 0; c < cables; ++c) {
    for (std::size_t a = thetas.first; a < thetas.count; ++a) {
      torque[a] += jacobian[c][a] * tension[c];
      for (std::size_t b = thetas.first; b < thetas.count; ++b) gram[a][b] += jacobian[c][a] * jacobian[c][b];
    }
  }
  Theta multiplier{};
  if (!solve_spd(gram, torque, thetas.count, multiplier))
    throw std::runtime_error("physics: the cables do not fix the arm at the start pose; choose another");
  for (std::size_t c = 0; c < cables; ++c)
    for (std::size_t a = thetas.first; a < thetas.count; ++a) tension[c] -= jacobian[c][a] * multiplier[a];
}

}  // namespace

CableValues balanced_tensions(const CablePaths& paths, std::size_t theta_count, const Theta& weight_Nm, double wanted_N,
                              double floor_N) {
  constexpr int kMaxRounds = 10000;
  const std::size_t cables = paths.cable_count();
  const CableJacobian jacobian = paths.jacobian();
  CableValues tension{};
  std::fill_n(tension.begin(), cables, wanted_N);
  const Thetas thetas{2 * paths.first_segment(), theta_count};
  project(jacobian, cables, thetas, weight_Nm, tension);
  for (int round = 0; round < kMaxRounds; ++round) {
    if (*std::min_element(tension.begin(), tension.begin() + static_cast<std::ptrdiff_t>(cables)) >= floor_N)
      return tension;
    // A little above the floor, so that the rounds end.
    for (std::size_t c = 0; c < cables; ++c) tension[c] = std::max(tension[c], 1.05 * floor_N);
    project(jacobian, cables, thetas, weight_Nm, tension);
  }
  throw std::runtime_error(
      "physics: no balanced tensions above the floor at the start pose; choose another start pose, or less --gravity");
}

}  // namespace liana::bench
