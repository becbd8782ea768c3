// What tensions do for a cable that is named by a fault while the arm is led back (CommandKind::kRetract).
#pragma once

#include "firmware_like/cable/arm/cables.hpp"
#include "firmware_like/safety/faults.hpp"

namespace liana::cable {

// Times TensionLimits::scale. A segment with a cable that slipped, creeps or was overloaded is pulled so much less, one
// with a slack cable so much more: a fourth of the planned level, which leaves every other cable over its floor.
constexpr double kSparing_N = 10.0;
constexpr double kSparingRate_N_s = 5.0;  // slower than the arm's modes

// One tick of `lift_N` (tension.hpp) towards that. Faults that name no cable change nothing; one that spares wins over
// one that tightens.
void spare_cables(const RobotParams& table, const CableLayout& layout, const FaultList& faults,
                  SegmentVector& lift_N) noexcept;

}  // namespace liana::cable
