// Where the drums want the angles while the drives follow what they are told: first order, the same for all of them.
#pragma once

#include <cmath>

#include "host/algebra/thetas.hpp"

namespace liana::simulate {

class DrumLag {
 public:
  // At the start the drives have followed a motion of `rate_rad_s` for long.
  DrumLag(double time_constant_s, double step_s, const algebra::ThetaColumn& told_rad,
          const algebra::ThetaColumn& rate_rad_s)
      : tau_s_(time_constant_s),
        step_s_(step_s),
        left_(std::exp(-step_s / time_constant_s)),
        told_rad_(told_rad),
        drums_rad_(told_rad - time_constant_s * rate_rad_s) {}

  // A step in which the drives are told a straight way on to `told_rad`: the exact solution.
  void step(const algebra::ThetaColumn& told_rad) {
    const algebra::ThetaColumn behind_rad = tau_s_ / step_s_ * (told_rad - told_rad_);
    drums_rad_ = told_rad - behind_rad + left_ * (drums_rad_ - told_rad_ + behind_rad);
    told_rad_ = told_rad;
  }
  const algebra::ThetaColumn& drums_rad() const { return drums_rad_; }

 private:
  double tau_s_, step_s_, left_;
  algebra::ThetaColumn told_rad_, drums_rad_;
};

}  // namespace liana::simulate
