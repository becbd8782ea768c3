#include "hil/arm/stable_step.hpp"

#include <stdexcept>

namespace liana::bench {

namespace {

constexpr double kReserve = 2.0;  // of the stiffness: poses and tensions change it

bool bears(const ThetaMatrix& mass, const ThetaMatrix& stiffness, double viscous_Nms_per_rad, std::size_t thetas,
           double step_s) {
  ThetaMatrix margin{};
  for (std::size_t a = 0; a < thetas; ++a) {
    for (std::size_t b = 0; b <= a; ++b) margin[a][b] = 4.0 * mass[a][b] - kReserve * step_s * step_s * stiffness[a][b];
    margin[a][a] += 2.0 * step_s * viscous_Nms_per_rad;
  }
  Theta unused{};
  return solve_spd(margin, Theta{}, thetas, unused);
}

}  // namespace

double stable_step_s(const ThetaMatrix& mass, const ThetaMatrix& stiffness, double viscous_Nms_per_rad,
                     std::size_t thetas, double longest_s) {
  for (double step_s = longest_s; step_s >= kShortestStep_s; step_s *= 0.5)
    if (bears(mass, stiffness, viscous_Nms_per_rad, thetas, step_s)) return step_s;
  throw std::runtime_error(
      "robot: cables.EA_N: too stiff for links of module.mass_kg: they swing faster than the physics can follow "
      "(steps of 0.01 ms); lower it, or give heavier modules or more joint.viscous_Nms_per_rad");
}

}  // namespace liana::bench
