#include "host/apps/report/guaranteed_clearance.hpp"

#include <algorithm>
#include <limits>

namespace liana::report {

std::optional<VerifiedClearance> verified_clearance(const TruthLog& truth, std::size_t first, std::size_t last,
                                                    const std::vector<ClearanceBounds>& claims, double period_s) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  VerifiedClearance out{kInfinity, kInfinity, 0, 0.0};
  std::size_t next = 0;  // first claim after the row's slot
  for (std::size_t row = first; row <= last; ++row) {
    const auto slot = static_cast<std::uint64_t>(truth.at(row, "slot"));
    while (next < claims.size() && claims[next].tick <= slot) ++next;
    if (next == 0) continue;
    const ClearanceBounds& claim = claims[next - 1];
    if (static_cast<double>(slot - claim.tick) * period_s > kClaimStands_s) continue;
    const double true_m = truth.at(row, "clearance_m");
    out.min_m = std::min(out.min_m, claim.distance_m);
    out.truth_min_m = std::min(out.truth_min_m, true_m);
    if (claim.distance_m <= true_m) continue;
    ++out.ticks_above_truth;
    out.max_above_m = std::max(out.max_above_m, claim.distance_m - true_m);
  }
  return out.min_m == kInfinity ? std::nullopt : std::optional(out);
}

}  // namespace liana::report
