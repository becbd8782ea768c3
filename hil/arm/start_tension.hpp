// Tensions that hold the arm still: J^T t + w = 0, w what gravity asks of the joints; those of a base are left out.
#pragma once

#include "hil/arm/cable_geometry.hpp"

namespace liana::bench {

// Before anybody pulls on purpose: of what the robot's table plans.
constexpr double kStartTensionOfPlan = 0.75;
constexpr double kStartFloorOfPlan = 0.375;

// Nearest balanced tensions under `weight_Nm` (Chain::bias at rest) to `wanted_N` everywhere with none below `floor_N`
// (alternating projections on the null space of the transposed cable Jacobian and the floor). Throws std::runtime_error
// when there are none.
CableValues balanced_tensions(const CablePaths& paths, std::size_t theta_count, const Theta& weight_Nm, double wanted_N,
                              double floor_N);

}  // namespace liana::bench
