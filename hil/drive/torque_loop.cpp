#include "hil/drive/torque_loop.hpp"

#include <algorithm>

namespace liana::bench {

double TorqueLoop::step(double step_s, const TorqueGains& gains, const TorqueTarget& target, const GearReading& gear,
                        double max_Nm) {
  const double slip = target.rate_rad_s - gear.rate_rad_s;
  const double drift = drift_rad_ + step_s * slip;
  const double held = target.feed_forward_Nm + gains.damping_Nms_rad * gains.drift_per_s * drift;
  const double wanted = held + gains.damping_Nms_rad * slip;
  const double error = wanted - gear.torque_Nm;
  const double sum = sum_Nms_ + step_s * error;
  const double change = has_last_ ? (gear.torque_Nm - last_Nm_) / step_s : 0.0;
  const double motor = wanted + gains.gain * error + gains.integral_per_s * sum - gains.derivative_s * change;
  last_Nm_ = gear.torque_Nm;
  has_last_ = true;
  held_Nm_ = std::clamp(held, -max_Nm, max_Nm);
  if (motor > max_Nm || motor < -max_Nm) return std::clamp(motor, -max_Nm, max_Nm);
  drift_rad_ = drift;
  sum_Nms_ = sum;
  return motor;
}

double TorqueStop::step(double step_s, bool rests) {
  const double left = ramp_s_ > 0.0 ? std::max(0.0, 1.0 - elapsed_s_ / ramp_s_) : 0.0;
  elapsed_s_ += step_s;
  rested_s_ = rests ? rested_s_ + step_s : 0.0;
  return left * held_Nm_;
}

}  // namespace liana::bench
