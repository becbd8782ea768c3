// Which way every cable slips at every segment, as planned: the sign of capstan friction with presliding.
#pragma once

#include <array>

#include "firmware_like/cable/arm/cables.hpp"

namespace liana::cable {

// +1: the cable slides towards the motor (it is wound in), tension falls away from the motor; -1: the other way;
// between: presliding. Dahl's model: d sigma = (u / delta) (1 - sigma sign u), u the slip towards the motor, delta the
// presliding distance.
struct SlipState {
  std::array<std::array<double, kMaxSegments>, kMaxCables> sigma{};
  CableParts part_m{};  // cable paths when sigma was last advanced
};

// Presliding distance: the stretch that friction can hold, mu beta T / k, is 0.02 to 0.3 mm here; smooth enough for the
// motors.
constexpr double kPreslidingDistance_m = 2.0e-4;

// Nothing has slipped yet at this geometry.
void reset_slip(const CableGeometry& geometry, SlipState& slip) noexcept;

// Advances sigma by the change of cable paths since the last call.
void advance_slip(const CableLayout& layout, const CableParts& part_m, double presliding_m, SlipState& slip) noexcept;
// The same with the planned paths.
inline void advance_slip(const CableLayout& layout, const CableGeometry& geometry, SlipState& slip) noexcept {
  advance_slip(layout, geometry.part_m, kPreslidingDistance_m, slip);
}
// A dither leaves friction nowhere to stay: so much of what is left of every sigma goes, `share` 0 to 1.
void fade_slip(const CableLayout& layout, double share, SlipState& slip) noexcept;

// Tension in the middle of each segment divided by tension at the motor: exp(-mu sum sigma wrap). Row c, segment j;
// entries beyond a cable's own segment are not written. Cost: one exponential per cable and segment passed.
using TensionRatio = std::array<std::array<double, kMaxSegments>, kMaxCables>;
// `wrap_rad` is what cable_wraps says.
void update_tension_ratio(const RobotParams& table, const CableLayout& layout, const SegmentVector& wrap_rad,
                          const SlipState& slip, TensionRatio& ratio) noexcept;
TensionRatio tension_ratio(const RobotParams& table, const CableLayout& layout, const ArmTrig& trig,
                           const SlipState& slip) noexcept;

}  // namespace liana::cable
