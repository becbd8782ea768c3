#include "host/operator/haptics/prediction_track.hpp"

#include <algorithm>

namespace liana::haptics {
namespace {

Vec3 between(const Vec3& from, const Vec3& to, double share) { return add(from, scale(subtract(to, from), share)); }

}  // namespace

void PredictionTrack::put(std::int64_t t_us, const Motion& tip) noexcept {
  if (count_ > 0 && t_us <= back(0).t_us) return;
  ring_[count_ % kMost] = {t_us, tip};
  ++count_;
}

std::optional<Motion> PredictionTrack::newest() const noexcept {
  if (count_ == 0) return std::nullopt;
  return back(0).tip;
}

std::optional<Motion> PredictionTrack::at(std::int64_t t_us) const noexcept {
  const std::size_t kept = std::min(count_, kMost);
  for (std::size_t steps = 0; steps < kept; ++steps) {
    const Entry& before = back(steps);
    if (before.t_us > t_us) continue;
    if (steps == 0) return before.tip;
    const Entry& after = back(steps - 1);
    const double share = static_cast<double>(t_us - before.t_us) / static_cast<double>(after.t_us - before.t_us);
    return Motion{between(before.tip.position_m, after.tip.position_m, share),
                  between(before.tip.velocity_m_s, after.tip.velocity_m_s, share)};
  }
  return std::nullopt;
}

}  // namespace liana::haptics
