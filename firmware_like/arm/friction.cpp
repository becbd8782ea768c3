#include "firmware_like/arm/friction.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana {

using Index = std::size_t;

void advance_slip(const RobotTable& table, const CableLayout& layout, const CableGeometry& before, const CableGeometry& now,
                  SlipState& slip) noexcept {
  for (Index c = 0; c < static_cast<Index>(table.cable_count()); ++c) {
    double beyond = 0.0;  // change of path from the middle of segment j to the anchor
    for (std::int32_t m = layout.segment[c]; m >= 0; --m) {
      const Index j = static_cast<Index>(m);
      const double change = now.part_m[c][j] - before.part_m[c][j];
      const double slide = -(beyond + 0.5 * change);  // a shrinking path pulls the cable towards the motor
      beyond += change;
      double& sigma = slip.sigma[c][j];
      sigma = clamp(sigma + slide / kPreslidingDistance_m - std::fabs(slide) / kPreslidingDistance_m * sigma, -1.0, 1.0);
    }
  }
}

TensionRatio tension_ratio(const RobotTable& table, const CableLayout& layout, const CableGeometry& geometry,
                           const SlipState& slip) noexcept {
  TensionRatio ratio{};
  for (Index c = 0; c < static_cast<Index>(table.cable_count()); ++c) {
    double at_entry = 1.0;
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j) {
      const double half = exponential(-0.5 * table.friction_mu * slip.sigma[c][j] * geometry.wrap_rad[j]);
      ratio[c][j] = at_entry * half;
      at_entry *= half * half;
    }
  }
  return ratio;
}

}  // namespace liana
