// Cable lengths as a textbook has them: every hole of every disc, hole to hole, joint by joint; the derivative by
// central differences.
#pragma once

#include "firmware_like/arm/cables.hpp"

namespace liana::bench {

// Path of every cable from the first disc to its anchor [m]; of the layout only where the holes are.
CableVector textbook_lengths(const RobotTable& table, const CableLayout& layout, const ThetaVector& theta_rad);

// The same with d length / d theta, step 1e-5 rad: exact to about 1e-10 m/rad.
CableGeometry textbook_cables(const RobotTable& table, const CableLayout& layout, const ThetaVector& theta_rad);

}  // namespace liana::bench
