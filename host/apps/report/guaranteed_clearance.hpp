// What lianad claimed of the arm's clearance, held against what the physics did.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "host/apps/report/truth.hpp"

namespace liana::report {

// One claim of lianad: of the angles measured at `tick`.
struct ClearanceBounds {
  std::uint64_t tick = 0;
  double distance_m = 0.0;
};

// Claims against true clearances, slot by slot: a claim stands until the next one, for kClaimStands_s at most.
struct VerifiedClearance {
  double min_m = 0.0;        // least claim
  double truth_min_m = 0.0;  // least true clearance while a claim stood
  std::uint64_t ticks_above_truth = 0;
  double max_above_m = 0.0;  // by how much the worst of them was above the truth; 0: none was
};
constexpr double kClaimStands_s = 0.1;

// Rows first..last of the truth; nothing where no claim stood. `claims` by rising tick.
std::optional<VerifiedClearance> verified_clearance(const TruthLog& truth, std::size_t first, std::size_t last,
                                                    const std::vector<ClearanceBounds>& claims, double period_s);

}  // namespace liana::report
