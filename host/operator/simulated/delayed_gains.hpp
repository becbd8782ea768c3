// How people work behind a delay that they know: they wait longer before they believe what they see, correct less at
// once and start more gently. Who corrects less swings longer about a goal that friction holds off, and settles for
// less where nothing is near.
#pragma once

#include "host/operator/simulated/hand_gains.hpp"
#include "host/operator/simulated/vr_gains.hpp"

namespace liana::simulated {

// `there_and_back_s` >= 0: from a movement of the hand to its picture, beyond what there always is.
inline HandGains under_delay(HandGains gains, double there_and_back_s) {
  gains.camera_latency_s += there_and_back_s;
  gains.look_s += there_and_back_s;
  gains.arm_stops_s += there_and_back_s;
  gains.patience_s += 1.5 * there_and_back_s;
  gains.along_quiet_s += there_and_back_s;
  gains.align_dwell_s += there_and_back_s;
  gains.align_relent_most += 0.5 * there_and_back_s;
  gains.correction_per_s /= 1.0 + there_and_back_s;
  return gains;
}

inline VrGains under_delay(VrGains gains, double there_and_back_s) {
  gains.look_s += there_and_back_s;
  gains.arm_stops_s += there_and_back_s;
  gains.patience_s += 1.5 * there_and_back_s;
  gains.there_dwell_s += there_and_back_s;
  gains.accel_m_s2 /= 1.0 + there_and_back_s;
  gains.wait_from_m += gains.speed_m_s * there_and_back_s;
  gains.wait_full_m += gains.speed_m_s * there_and_back_s;
  return gains;
}

}  // namespace liana::simulated
