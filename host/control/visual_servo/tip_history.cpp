#include "host/control/visual_servo/tip_history.hpp"

#include "firmware_like/operator_input/tip_interval.hpp"

namespace liana::visual_servo {

namespace {

constexpr double kSameTime_s = 1e-6;  // capture times are rounded on their way here

}  // namespace

void TipHistory::note(double time_s, const Pose& tip_in_base) {
  if (count_ > 0 && time_s <= back(0).time_s) count_ = 0;
  notes_[next_] = {time_s, tip_in_base};
  next_ = (next_ + 1) % kHistoryLength;
  if (count_ < kHistoryLength) ++count_;
}

// `notes` before the newest.
const TipHistory::Note& TipHistory::back(std::size_t notes) const {
  return notes_[(next_ + kHistoryLength - 1 - notes) % kHistoryLength];
}

std::optional<Pose> TipHistory::at(double time_s) const {
  if (count_ == 0 || time_s > back(0).time_s + kSameTime_s) return std::nullopt;
  for (std::size_t i = 0; i < count_; ++i) {
    const Note& before = back(i);
    if (before.time_s > time_s + kSameTime_s) continue;
    if (i == 0) return before.tip_in_base;
    const Note& after = back(i - 1);
    const double share = (time_s - before.time_s) / (after.time_s - before.time_s);
    const Vec3 turn = rotation_vector(multiply(after.tip_in_base.quaternion, conjugate(before.tip_in_base.quaternion)));
    return interpolated_pose(before.tip_in_base, after.tip_in_base, turn, share < 0.0 ? 0.0 : share);
  }
  return std::nullopt;
}

}  // namespace liana::visual_servo
