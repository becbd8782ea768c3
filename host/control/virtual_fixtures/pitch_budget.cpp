#include "host/control/virtual_fixtures/pitch_budget.hpp"

#include <algorithm>
#include <cmath>

namespace liana::virtual_fixtures {

double pitch_lever_m(const RobotParams& table, std::int32_t segments) {
  double behind_m = 0.0, lever_m = 0.0;
  for (std::int32_t m = table.segment_count - 1; m >= table.segment_count - segments; --m) {
    const SegmentParams& segment = table.segment[static_cast<std::size_t>(m)];
    for (std::int32_t i = 0; i < segment.modules; ++i) lever_m += behind_m += segment.module_length_m;
  }
  return lever_m;
}

PitchBudget pitch_budget(const RobotParams& table, std::int32_t segments, double room_m,
                         const ThetaVector& believed_rad, const ThetaVector& commanded_rad) {
  if (segments == 0) return {};
  PitchBudget out{room_m / pitch_lever_m(table, segments), 0.0};
  for (std::int32_t m = table.segment_count - segments; m < table.segment_count; ++m) {
    const auto pitch = static_cast<std::size_t>(2 * m);
    out.used_rad = std::max(out.used_rad, std::fabs(believed_rad[pitch] - commanded_rad[pitch]));
  }
  return out;
}

}  // namespace liana::virtual_fixtures
