// A dither that was asked for, interval by interval: it begins with its full share, which the core lets grow, and
// decays evenly to nothing.
#pragma once

namespace liana::arbiter {

class DitherOrder {
 public:
  DitherOrder() = default;  // none
  DitherOrder(double share, double duration_s) : share_(share), duration_s_(duration_s) {}

  bool is_under_way() const { return time_s_ < duration_s_; }
  // Share for the interval that begins now; it is over then when this was the last one.
  double next(double interval_s) {
    const double share = share_ * (1.0 - time_s_ / duration_s_);
    time_s_ += interval_s;
    return share;
  }

 private:
  double share_ = 0.0, duration_s_ = 0.0, time_s_ = 0.0;
};

}  // namespace liana::arbiter
