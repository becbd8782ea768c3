// Where drums, or angles, are while the drives follow what they are told: first order, the same for all of them.
#pragma once

#include <cmath>

namespace liana::simulation {

template <class Column>
class DrumLag {
 public:
  DrumLag() = default;
  // At the start the drives have followed a motion of `rate` for long.
  DrumLag(double time_constant_s, double step_s, const Column& told, const Column& rate)
      : tau_s_(time_constant_s),
        step_s_(step_s),
        left_(std::exp(-step_s / time_constant_s)),
        told_(told),
        now_(told - time_constant_s * rate) {}

  // A step in which the drives are told a straight way on to `told`: the exact solution.
  void step(const Column& told) {
    const Column behind = tau_s_ / step_s_ * (told - told_);
    now_ = told - behind + left_ * (now_ - told_ + behind);
    told_ = told;
  }
  const Column& now() const { return now_; }

 private:
  double tau_s_ = 0.0, step_s_ = 0.0, left_ = 0.0;
  Column told_, now_;
};

}  // namespace liana::simulation
