#include "host/control/arbiter/hand_track.hpp"

namespace liana::arbiter {

namespace {
double seconds(std::int64_t us) { return static_cast<double>(us) * 1e-6; }
}  // namespace

// Positions are averaged as they are; rotations as small turns away from the first sample of the interval.
void HandTrack::average_in(const Pose& pose) {
  if (reading_.used == 0) first_ = pose;
  position_sum_m_ = add(position_sum_m_, pose.position_m);
  turn_sum_rad_ = add(turn_sum_rad_, rotation_vector(multiply(pose.quaternion, conjugate(first_.quaternion))));
  ++reading_.used;
}

void HandTrack::add_sample(const device::Sample& sample) {
  ++reading_.samples;
  if (any_ && sample.t_us <= last_t_us_) return;
  any_ = true;
  last_t_us_ = sample.t_us;
  reading_.pressed = sample.deadman;
  if (!sample.deadman) {
    reading_.let_go = true;
    reading_.used = 0;  // what was averaged before belongs to the old grip
    position_sum_m_ = turn_sum_rad_ = Vec3{};
  }
  if (!sample.valid || !is_valid(sample.pose)) return;
  any_good_ = true;
  last_good_t_us_ = sample.t_us;
  if (sample.deadman) average_in(sample.pose);
}

HandReading HandTrack::finish_interval() {
  HandReading reading = reading_;
  reading.has_mean = reading.used > 0;
  if (reading.has_mean) {
    const double share = 1.0 / reading.used;
    reading.mean = {scale(position_sum_m_, share),
                    normalize(multiply(quaternion_of(scale(turn_sum_rad_, share)), first_.quaternion))};
  }
  reading.lost = any_ && (!any_good_ || seconds(last_t_us_ - last_good_t_us_) > kTrackingLost_s);
  const bool pressed = reading_.pressed;
  reading_ = HandReading{};
  reading_.pressed = pressed;
  reading_.mean = reading.mean;
  position_sum_m_ = turn_sum_rad_ = Vec3{};
  return reading;
}

}  // namespace liana::arbiter
