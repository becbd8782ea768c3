#include "host/api/device/sample_rate.hpp"

#include <algorithm>

namespace liana::device {

namespace {

constexpr double kSecond_s = 1.0 - 1e-9;  // sums of command intervals are not exact

double seconds(std::int64_t us) { return static_cast<double>(us) * 1e-6; }

}  // namespace

void SampleRate::add(std::int64_t t_us) {
  if (count_++ == 0) {
    first_us_ = last_us_ = second_from_us_ = t_us;
    return;
  }
  if (t_us <= last_us_) return;
  const double interval_s = seconds(t_us - last_us_);
  min_s_ = intervals_ == 0 ? interval_s : std::min(min_s_, interval_s);
  max_s_ = std::max(max_s_, interval_s);
  last_us_ = t_us;
  ++intervals_;
  ++in_second_;
}

double SampleRate::mean_hz() const {
  return intervals_ > 0 ? static_cast<double>(intervals_) / seconds(last_us_ - first_us_) : 0.0;
}

void SampleRate::finish_interval(double interval_s) {
  if (count_ == 0) return;  // a device that has not begun is not slow
  second_s_ += interval_s;
  if (second_s_ < kSecond_s) return;
  now_hz_ = in_second_ > 0 ? static_cast<double>(in_second_) / seconds(last_us_ - second_from_us_) : 0.0;
  is_slow_ = *now_hz_ < kMinRate_hz - (is_slow_ ? 0.0 : kRateTolerance_hz);
  second_s_ = 0.0;
  in_second_ = 0;
  second_from_us_ = last_us_;
}

}  // namespace liana::device
