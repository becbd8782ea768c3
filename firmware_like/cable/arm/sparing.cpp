#include "firmware_like/cable/arm/sparing.hpp"

#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

// Lift that this fault asks for in the segment of its cable; 0: none.
double asked_N(FaultNumber number) noexcept {
  switch (number) {
    case FaultNumber::kCableSlip:
    case FaultNumber::kTensionAlarm:
    case FaultNumber::kHomingImplausible:
      return -kSparing_N;
    case FaultNumber::kCableSlack:
      return kSparing_N;
    default:
      return 0.0;
  }
}

}  // namespace

void spare_cables(const RobotParams& table, const CableLayout& layout, const FaultList& faults,
                  SegmentVector& lift_N) noexcept {
  SegmentVector wanted_N = lift_N;
  for (std::int32_t i = 0; i < faults.count; ++i) {
    const Fault& fault = faults.fault[as_index(i)];
    const double asked = asked_N(fault.number) * table.tension.scale();
    if (asked == 0.0 || fault.index < 0 || fault.index >= layout.cable_count) continue;
    const double least_N = -kSparing_N * table.tension.scale();
    double& wanted = wanted_N[as_index(layout.segment[as_index(fault.index)])];
    if (wanted > least_N) wanted = asked;
  }
  const double step_N = kSparingRate_N_s * table.tension.scale() * table.tick_s;
  for (std::size_t j = 0; j < as_index(table.segment_count); ++j)
    lift_N[j] += clamp(wanted_N[j] - lift_N[j], -step_N, step_N);
}

}  // namespace liana::cable
