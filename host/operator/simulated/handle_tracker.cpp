#include "host/operator/simulated/handle_tracker.hpp"

#include <cmath>

namespace liana::simulated {

HandleTracker::HandleTracker(const TrackingTable& table, std::uint64_t seed, std::uint64_t purpose)
    : table_(table),
      tremor_(table.tremor_m, table.tremor_rad, seed, purpose),
      random_(seed, purpose + 1),
      jump_s_(next_after(0.0)),
      lost_from_s_(next_after(0.0)),
      lost_to_s_(lost_from_s_ + table.dropout_least_s) {}

double HandleTracker::next_after(double now_s) { return now_s + random_.uniform(0.5, 1.5) * table_.between_s; }

device::Sample HandleTracker::track(const Pose& pose, bool held, double now_s) {
  device::Sample sample{.t_us = std::llround(now_s * 1e6), .deadman = held, .trigger = held ? 1.0 : 0.0};
  if (now_s >= lost_to_s_) {
    lost_from_s_ = next_after(now_s);
    lost_to_s_ = lost_from_s_ + random_.uniform(table_.dropout_least_s, table_.dropout_most_s);
  }
  sample.valid = now_s < lost_from_s_;
  if (sample.valid) last_ = tremor_.apply(pose, now_s);
  sample.pose = last_;
  if (!sample.valid || now_s < jump_s_) return sample;
  jump_s_ = next_after(now_s);
  sample.pose.position_m[1] += table_.jump_m;
  return sample;
}

}  // namespace liana::simulated
