// A way of moving: back along the path that was commanded. First nothing is asked for until the arm has come to rest; a
// refusal ends in rest, too, and the next start takes the place that was refused slowly. Where the arm was enabled
// beside the path it goes onto it by a joint move of its own.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "firmware_like/safety/faults.hpp"
#include "host/control/arbiter/arm_traits.hpp"
#include "host/control/arbiter/joint_move.hpp"
#include "host/control/arbiter/path_history.hpp"
#include "host/control/arbiter/retract_events.hpp"

namespace liana::arbiter {

// Path points per command interval on the way back: slower than the way in, so that what passed verification then
// passes it again.
constexpr double kWayBackPace = 0.8;
constexpr double kFaultyPace = 0.4;         // the same while a fault is latched
constexpr double kJoinRate_rad_s = 0.0052;  // fastest joint on the way onto the path: 0.3 deg/s

template <class Arm>
class RetractMove {
 public:
  static constexpr bool kIsPlanned = true;
  using Table = typename Arm::Table;
  using Memory = PathHistory<Joints<Arm>>;

  // Back to where the command stood at `until_tick`. `table` and `path` have to outlive this; points are taken off the
  // path once they have been left behind.
  RetractMove(const Table& table, Memory& path, std::uint64_t until_tick)
      : table_(table), path_(path), until_tick_(until_tick), max_wait_(intervals(kMaxWait_s)) {}

  // It has come to rest once: from now on the path is not to be noted. The stop before belongs to the way in.
  bool has_begun() const { return has_begun_; }
  RetractPhase phase() const {
    if (!rests()) return RetractPhase::kStopping;
    return path_.newest().begins ? RetractPhase::kJoining : RetractPhase::kBack;
  }
  std::size_t points_left() const { return std::max<std::size_t>(path_.count_since(until_tick_), 1) - 1; }
  // Empty when all the way has been gone, or is still under way.
  const std::string& why_ended() const { return why_ended_; }

  Goal<Arm> next(const liana::Outputs<Arm>& now) {
    if (!allow_retract(now.faults)) {
      why_ended_ = "a fault is latched that does not let the arm be led back";
      is_over_ = true;
      return {};
    }
    const bool was_faulty = std::exchange(is_faulty_, now.faults.count > 0 || ArmTraits<Arm>::recovers(table_, now));
    if (was_faulty != is_faulty_) start_again();
    if (!rests()) return come_to_rest(now);
    return arrived_ ? arrive(now) : step(now);
  }
  // All the way has been gone, or it cannot go on.
  bool is_over() const { return is_over_; }
  // Starts again from rest, at the newest point of the path; false when that was refused too often at one place.
  bool refused() {
    if (points_left() + kProgressPoints <= points_at_refusal_) starts_ = 0;
    if (starts_ == 0) points_at_refusal_ = points_left();
    start_again();
    if (++starts_ < kMaxStarts) return true;
    why_ended_ = "verification refused it " + std::to_string(kMaxStarts) + " times at one place";
    return false;
  }

 private:
  static constexpr std::int32_t kRestIntervals = 3;       // a command released before the stop may still be on its way
  static constexpr std::int32_t kMaxRestIntervals = 100;  // at rest the arm may still swing, and be refused for that
  static constexpr double kPaceGain = 0.005;              // per command interval: full pace after 3 s
  static constexpr double kRiseShare = 0.1;               // of a joint's fastest rate, each second
  static constexpr int kMaxStarts = 10;
  static constexpr std::size_t kProgressPoints = 10;  // further back than the refusal before: another place
  static constexpr double kMaxWait_s = 20.0;          // for rest
  static constexpr double kThere_rad = 1e-5;

  // Refused again and again: twice as long each time.
  std::int32_t needed_rest() const { return std::min(kRestIntervals << starts_, kMaxRestIntervals); }
  bool rests() const { return rest_intervals_ >= needed_rest(); }
  std::int32_t intervals(double time_s) const { return static_cast<std::int32_t>(time_s / interval_s(table_)); }

  // From rest.
  void start_again() {
    rest_intervals_ = waited_ = 0;
    pace_ = share_ = step_rad_ = 0.0;
    join_.reset();
    arrived_.reset();
  }
  // Nothing to ask for; ends what takes too long.
  Goal<Arm> come_to_rest(const liana::Outputs<Arm>& now) {
    rest_intervals_ = now.at_rest != 0 ? rest_intervals_ + 1 : 0;
    give_up_after_wait();
    if (rests() && std::exchange(has_begun_, true)) path_.come_back_to(ArmTraits<Arm>::command_rad(now));
    return {};
  }
  Goal<Arm> arrive(const liana::Outputs<Arm>& now) {
    is_over_ = now.at_rest != 0 && Memory::largest_change(ArmTraits<Arm>::command_rad(now), *arrived_) < kThere_rad;
    if (!is_over_) give_up_after_wait();
    return is_over_ ? Goal<Arm>() : Goal<Arm>(*arrived_);
  }
  void give_up_after_wait() {
    if (++waited_ <= max_wait_) return;
    why_ended_ = "the arm did not come to rest within 20 s";
    is_over_ = true;
  }

  // The point before the newest one, if the way leads so far.
  const typename Memory::Point* ahead() const {
    if (path_.size() < 2) return nullptr;
    const typename Memory::Point& point = path_.at(path_.size() - 2);
    return point.tick < until_tick_ ? nullptr : &point;
  }

  // One command interval on.
  Goal<Arm> step(const liana::Outputs<Arm>& now) {
    if (join_) return go_on_joining(now);
    pace_ = risen(std::min(is_faulty_ ? kFaultyPace : kWayBackPace, pace_ + kPaceGain));
    share_ += is_faulty_ ? std::min(pace_, retract_share()) : pace_;
    while (share_ >= 1.0 && ahead() != nullptr && !path_.newest().begins) pass_point();
    const typename Memory::Point* to = ahead();
    if (to == nullptr) {
      arrived_ = path_.newest().joint_rad;
      waited_ = 0;
      return *arrived_;
    }
    if (!path_.newest().begins) return between(path_.newest().joint_rad, to->joint_rad, share_);
    join_.emplace(table_, path_.newest().joint_rad, to->joint_rad, kJoinRate_rad_s);
    return go_on_joining(now);
  }
  // The way in may have ended its pieces with quick stops; the way back does not begin them as quickly, because the tip
  // of an arm that has stood in its friction springs ahead then. Braking is as quick as it was.
  double risen(double pace) {
    const typename Memory::Point* to = ahead();
    if (to == nullptr) return pace;
    const double way_rad = Memory::largest_change(path_.newest().joint_rad, to->joint_rad);
    const double max_rad =
        step_rad_ + kRiseShare * ArmTraits<Arm>::rate_rad_s(table_, 0) * interval_s(table_) * interval_s(table_);
    if (way_rad * pace > max_rad) pace = max_rad / way_rad;
    step_rad_ = way_rad * pace;
    return pace;
  }
  // Of the piece to the point ahead, as much as a retract may go in an interval, and some less.
  double retract_share() const {
    const typename Memory::Point* to = ahead();
    if (to == nullptr) return 1.0;
    double share = 1.0;
    for (std::size_t i = 0; i < ArmTraits<Arm>::joint_count(table_); ++i) {
      const double way_rad = std::fabs(to->joint_rad[i] - path_.newest().joint_rad[i]);
      const double max_rad = 0.8 * kRetractRateShare * ArmTraits<Arm>::rate_rad_s(table_, i) * interval_s(table_);
      if (way_rad > max_rad) share = std::min(share, max_rad / way_rad);
    }
    return share;
  }
  void pass_point() {
    path_.drop_newest();
    share_ -= 1.0;
  }
  Goal<Arm> go_on_joining(const liana::Outputs<Arm>& now) {
    const Goal<Arm> joint_rad = join_->next(now);
    if (!join_->is_over()) return joint_rad;
    join_.reset();
    path_.drop_newest();
    pace_ = share_ = step_rad_ = 0.0;
    return joint_rad;
  }

  const Table& table_;
  Memory& path_;
  std::uint64_t until_tick_;
  std::int32_t max_wait_;            // intervals
  std::int32_t rest_intervals_ = 0;  // in a row
  std::int32_t waited_ = 0;          // intervals, for rest
  bool has_begun_ = false;
  bool is_faulty_ = false;  // a fault is latched, or a cable is lost
  int starts_ = 0;          // refused at one place
  std::size_t points_at_refusal_ = 0;
  bool is_over_ = false;
  double pace_ = 0.0;                   // points per interval now
  double step_rad_ = 0.0;               // of the fastest joint, in the interval before
  double share_ = 0.0;                  // of the way from the newest point to the one before it
  std::optional<JointMove<Arm>> join_;  // onto the path
  std::optional<Joints<Arm>> arrived_;  // the end of the way is asked for
  std::string why_ended_;
};

}  // namespace liana::arbiter
