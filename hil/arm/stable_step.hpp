// How long a step of the arm's physics may be: cables are springs, stiff ones on light links swing quickly.
#pragma once

#include "hil/math/reduced.hpp"

namespace liana::bench {

// The longest of `longest_s`, its half, its quarter, ... that steps with velocity first, damping implicit and springs
// explicit bear: 2 (2 M + h D) - h^2 K is positive definite (no mode turns round and grows from step to step), with
// twice the stiffness K [N.m/rad] for what other poses make of it. Of mass and stiffness the lower triangles are read.
// Throws std::runtime_error when even kShortestStep_s is too long.
double stable_step_s(const ThetaMatrix& mass, const ThetaMatrix& stiffness, double viscous_Nms_per_rad,
                     std::size_t thetas, double longest_s);
constexpr double kShortestStep_s = 1e-5;

}  // namespace liana::bench
