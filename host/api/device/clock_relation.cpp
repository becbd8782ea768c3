#include "host/api/device/clock_relation.hpp"

namespace liana::device {

std::optional<std::int64_t> ClockRelation::arm_ahead_us() const {
  if (!now_ && !before_) return std::nullopt;
  if (!now_ || !before_) return (now_ ? now_ : before_)->arm_ahead_us;
  return (now_->took_us <= before_->took_us ? now_ : before_)->arm_ahead_us;
}

void ClockRelation::add(std::int64_t sent_us, std::int64_t came_us, std::int64_t taken_us, std::int64_t heard_us) {
  const std::int64_t took_us = (heard_us - sent_us) - (taken_us - came_us);
  if (took_us < 0 || taken_us < came_us) return;
  if (heard_us - window_us_ > kWindow_us) {
    before_ = now_;
    now_.reset();
    window_us_ = heard_us;
  }
  if (!now_ || took_us <= now_->took_us) now_ = Quickest{took_us, ((sent_us - came_us) + (heard_us - taken_us)) / 2};
  const std::int64_t ahead_us = *arm_ahead_us();
  down_s_ = static_cast<double>(came_us + ahead_us - sent_us) * 1e-6;
  up_s_ = static_cast<double>(heard_us - taken_us - ahead_us) * 1e-6;
}

}  // namespace liana::device
