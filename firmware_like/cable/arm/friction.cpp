#include "firmware_like/cable/arm/friction.hpp"

#include <cmath>

#include "firmware_like/math/scalar.hpp"
#include "firmware_like/math/trig.hpp"

namespace liana::cable {

namespace {

using Index = std::size_t;

// e^x for |x| <= 1/4 to 2e-8 of it, which is more than friction is known to: 1/6! ... 1/0!.
constexpr Series<7> kBriefExponential{both(1.0 / 720.0), both(1.0 / 120.0), both(1.0 / 24.0), both(1.0 / 6.0),
                                      both(1.0 / 2.0),   both(1.0),         both(1.0)};

constexpr double kBriefly = 0.25;

Pair friction_exponential(const Pair& x) noexcept {
  return within(x, kBriefly) ? evaluate(kBriefExponential, x) : exponential(x);
}

}  // namespace

void reset_slip(const CableGeometry& geometry, SlipState& slip) noexcept {
  slip = SlipState{};
  slip.part_m = geometry.part_m;
}

void advance_slip(const CableLayout& layout, const CableParts& part_m, double presliding_m, SlipState& slip) noexcept {
  const double per_metre = 1.0 / presliding_m;
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
    double beyond_m = 0.0;  // change of path from the middle of segment j to the anchor
    for (Index j = static_cast<Index>(layout.segment[c]) + 1; j-- > 0;) {
      const double change_m = part_m[c][j] - slip.part_m[c][j];
      const double slide =
          -(beyond_m + 0.5 * change_m) * per_metre;  // a shrinking path pulls the cable towards the motor
      beyond_m += change_m;
      slip.part_m[c][j] = part_m[c][j];
      const double sigma = slip.sigma[c][j];
      slip.sigma[c][j] = clamp(sigma + slide - std::fabs(slide) * sigma, -1.0, 1.0);
    }
  }
}

void fade_slip(const CableLayout& layout, double share, SlipState& slip) noexcept {
  for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c)
    for (Index j = 0; j <= static_cast<Index>(layout.segment[c]); ++j) slip.sigma[c][j] -= share * slip.sigma[c][j];
}

void update_tension_ratio(const RobotParams& table, const CableLayout& layout, const SegmentVector& wrap_rad,
                          const SlipState& slip, TensionRatio& ratio) noexcept {
  SegmentVector half_rate = wrap_rad;
  double largest = 0.0;
  for (double& rate : half_rate) {
    rate *= -0.5 * table.friction_mu;
    largest = larger(largest, std::fabs(rate));
  }
  const auto fill = [&](auto power) noexcept {
    for (Index c = 0; c < static_cast<Index>(layout.cable_count); ++c) {
      double at_entry = 1.0;
      for (Index j = 0; j <= static_cast<Index>(layout.segment[c]);
           j += 2) {  // two segments at a time; nothing slips beyond the cable's own
        const Pair half = power(load_pair(&half_rate[j]) * load_pair(&slip.sigma[c][j]));
        const double at_next = at_entry * (half[0] * half[0]);
        store_pair(Pair{at_entry, at_next} * half, &ratio[c][j]);
        at_entry = at_next * (half[1] * half[1]);
      }
    }
  };
  if (largest <= kBriefly) {  // no sigma is beyond 1
    fill([](const Pair& x) noexcept { return evaluate(kBriefExponential, x); });
  } else {
    fill([](const Pair& x) noexcept { return friction_exponential(x); });
  }
}

TensionRatio tension_ratio(const RobotParams& table, const CableLayout& layout, const ArmTrig& trig,
                           const SlipState& slip) noexcept {
  TensionRatio ratio{};
  update_tension_ratio(table, layout, cable_wraps(table, trig), slip, ratio);
  return ratio;
}

}  // namespace liana::cable
