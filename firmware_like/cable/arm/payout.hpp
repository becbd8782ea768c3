// Cable length and drive position of one drum (docs/reference/drives.md, "Counts and lengths").
#pragma once

#include <cstdint>

#include "firmware_like/cable/arm/robot_params.hpp"
#include "firmware_like/math/convert.hpp"

namespace liana::cable {

// Unstretched cable length [m] between drum and anchor at a drive position. `zero_payout_m` is the length at
// `zero_counts`: cable path at the zero pose plus lead (docs/reference/drives.md, "Counts and lengths").
constexpr double payout_at_counts(const DriveParams& drive, double zero_payout_m, std::int32_t counts) noexcept {
  const double turned = static_cast<double>(counts) - static_cast<double>(drive.zero_counts);
  return zero_payout_m + static_cast<double>(drive.direction) * turned * drive.metres_per_count;
}

// Drive position that gives an unstretched cable length of `payout_m`, not rounded; inverse of payout_at_counts.
constexpr double counts_at_payout(const DriveParams& drive, double zero_payout_m, double payout_m) noexcept {
  const double turned = (payout_m - zero_payout_m) / drive.metres_per_count;
  return static_cast<double>(drive.zero_counts) + static_cast<double>(drive.direction) * turned;
}

}  // namespace liana::cable
