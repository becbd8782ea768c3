// Filters for one coordinate of a hand, beside the core's: the 1-Euro filter and a low-pass of second order.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace liana::numbers {

// Casiez, Roussel and Vogel (CHI 2012): a low-pass whose cut-off rises with speed, which passes a low-pass of 1 Hz.
class OneEuro {
 public:
  OneEuro(double cutoff_hz, double per_speed, double tick_s)
      : cutoff_hz_(cutoff_hz), per_speed_(per_speed), tick_s_(tick_s) {}
  double step(double in) {
    speed_ += share(1.0) * ((in - last_) / tick_s_ - speed_);
    last_ = in;
    return out_ += share(cutoff_hz_ + per_speed_ * std::fabs(speed_)) * (in - out_);
  }

 private:
  double share(double cutoff_hz) const { return 1.0 / (1.0 + 1.0 / (2.0 * std::numbers::pi * cutoff_hz * tick_s_)); }

  double cutoff_hz_, per_speed_, tick_s_;
  double last_ = 0.0, speed_ = 0.0, out_ = 0.0;
};

// Two equal poles; late by 1 / (pi cutoff).
class LowPass {
 public:
  LowPass(double cutoff_hz, double tick_s) : share_(1.0 - std::exp(-2.0 * std::numbers::pi * cutoff_hz * tick_s)) {}
  double step(double in) {
    middle_ += share_ * (in - middle_);
    return out_ += share_ * (middle_ - out_);
  }

 private:
  double share_;
  double middle_ = 0.0, out_ = 0.0;
};

}  // namespace liana::numbers
