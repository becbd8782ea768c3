// Cable lengths as a textbook has them: every hole of every disc, hole to hole, joint by joint; the derivative by
// central differences.
#pragma once

#include "firmware_like/cable/arm/cables.hpp"

namespace liana::bench {

// Path of every cable from the first disc to its anchor [m]; of the layout only where the holes are.
cable::CableVector textbook_lengths(const cable::RobotParams& table, const cable::CableLayout& layout,
                                    const cable::ThetaVector& theta_rad);

// The same with d length / d theta, step 1e-5 rad: exact to about 1e-10 m/rad.
cable::CableGeometry textbook_cables(const cable::RobotParams& table, const cable::CableLayout& layout,
                                     const cable::ThetaVector& theta_rad);

}  // namespace liana::bench
