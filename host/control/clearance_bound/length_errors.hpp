// What errors of cable lengths do to the angles that are made of them.
#pragma once

#include <array>

#include "firmware_like/cable/arm/cables.hpp"

namespace liana::clearance_bound {

using namespace cable;  // this room serves the cable arm only

// Column c: what one metre more of cable c changes of the measured angles [rad/m], at one pose.
using AnglesOfLengths = std::array<ThetaVector, kMaxCables>;

// By the core's own way from lengths to angles (cables.hpp), at the measured pose. 15 cables: about 2 us.
AnglesOfLengths angles_of_lengths(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad);

// How much longer each cable gets than measured when friction is `mu` more than was told: pulled with `tension_N` at
// the drum, with the bends that it passes at one pose. Its sign turns with the motion.
CableVector lengths_of_friction(const RobotParams& table, const CableLayout& layout, const ThetaVector& theta_rad,
                                double mu, double tension_N);

// `theta_rad` changed by `length_m` of every cable.
ThetaVector changed(const AnglesOfLengths& angles, const ThetaVector& theta_rad, const CableVector& length_m,
                    std::int32_t cables);

}  // namespace liana::clearance_bound
