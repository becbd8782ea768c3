#include "host/operator/handle_tracker.hpp"

namespace liana::operator_side {

HandleTracker::HandleTracker(const TrackingTable& table, std::uint64_t seed, std::uint64_t purpose)
    : table_(table),
      tremor_(table.tremor_m, table.tremor_rad, seed, purpose),
      random_(seed, purpose + 1),
      jump_s_(next_after(0.0)),
      lost_from_s_(next_after(0.0)),
      lost_to_s_(lost_from_s_ + table.dropout_least_s) {}

double HandleTracker::next_after(double now_s) { return now_s + random_.uniform(0.5, 1.5) * table_.between_s; }

VrHandle HandleTracker::track(const Pose& pose, double trigger, double now_s) {
  if (now_s >= lost_to_s_) {
    lost_from_s_ = next_after(now_s);
    lost_to_s_ = lost_from_s_ + random_.uniform(table_.dropout_least_s, table_.dropout_most_s);
  }
  if (now_s >= lost_from_s_) return {false, trigger, last_};
  last_ = tremor_.apply(pose, now_s);
  if (now_s < jump_s_) return {true, trigger, last_};
  jump_s_ = next_after(now_s);
  Pose off = last_;
  off.position_m[1] += table_.jump_m;
  return {true, trigger, off};
}

}  // namespace liana::operator_side
