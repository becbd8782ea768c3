// The verified way back out at every moment: what has been commanded, kept while the arm is disabled and joined again
// when it is enabled beside it; and how a retract along it fares.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "host/control/arbiter/retract_move.hpp"

namespace liana::arbiter {

// An arm that is enabled this near to a point of the path (any node and the tip) can go back onto it; farther away the
// path is given up, and said to be.
constexpr double kJoin_m = 0.05;

template <class Arm>
class RetractRequest {
 public:
  using Table = typename Arm::Table;
  using Memory = PathHistory<Joints<Arm>>;

  explicit RetractRequest(const Table& table) : table_(table) {}

  Memory& path() { return path_; }
  const Memory& path() const { return path_; }
  // The arm is not enabled: the path waits.
  void wait() { is_joined_ = went_back_ = false; }
  // Once per command interval in which the arm is enabled: where the command stands. While it goes back along the path,
  // or only `stops` after that, nothing is noted: a stop goes on along the path, and would be a cusp in it. In the
  // first one the path is joined, or given up.
  void stand(std::uint64_t tick, const Joints<Arm>& joint_rad, bool goes_back, bool stops) {
    if (!std::exchange(is_joined_, true)) return join(tick, joint_rad);
    const bool is_back = goes_back || (went_back_ && stops);
    if (std::exchange(went_back_, is_back) && !is_back) path_.come_back_to(joint_rad);
    if (!is_back) path_.note(tick, joint_rad);
    if (retract_.phase == RetractPhase::kDone && Memory::largest_change(joint_rad, done_rad_) > kMoved_rad)
      retract_ = {};
  }

  // Empty when a retract to `until_tick` has a way to go back along, or stands at its end; otherwise why not.
  std::string why_no_way(std::uint64_t until_tick) const {
    if (!is_joined_) return "the arm has just been enabled: ask again in the next command interval";
    const bool is_there = !path_.empty() && until_tick > 0 && path_.at(0).tick <= until_tick;
    return path_.size() > 1 || is_there ? "" : "there is no stored path to go back along" + why_lost_;
  }

  // A retract begins, or ends by itself or because of something else (`why`; empty: all the way).
  void begin(std::uint64_t until_tick) {
    until_tick_ = until_tick;
    retract_ = {};
    retract_.points = points_left();
    tell(event::RetractEvent::kBegins, points_left(), 0.0,
         "retract: " + count_text(points_left()) + " to go back along");
  }
  void end(const std::string& why, const Joints<Arm>& joint_rad);
  const RetractState& last_retract() const { return retract_; }

  std::vector<RetractEvents> take_events() { return std::exchange(news_, {}); }

 private:
  static constexpr double kSamePlace_m = 0.005;  // the newest point is preferred to one that is so much nearer
  static constexpr double kMoved_rad = 1e-4;     // after a retract: the arm is no longer back

  static std::string count_text(std::size_t points) { return std::to_string(points) + " points of the path"; }
  static std::string mm_text(double m) { return std::to_string(static_cast<int>(std::lround(1e3 * m))) + " mm"; }
  std::size_t points_left() const { return std::max<std::size_t>(path_.count_since(until_tick_), 1) - 1; }
  void tell(event::RetractEvent what, std::size_t points, double distance_m, std::string text) {
    news_.push_back({what, points, distance_m, std::move(text)});
  }
  void join(std::uint64_t tick, const Joints<Arm>& joint_rad);

  const Table& table_;
  Memory path_;
  bool is_joined_ = false;
  bool went_back_ = false;  // and has not come to rest, or been led elsewhere, since
  std::string why_lost_;    // of the path before this one
  std::uint64_t until_tick_ = 0;
  RetractState retract_;
  Joints<Arm> done_rad_{};  // where the last one ended
  std::vector<RetractEvents> news_;
};

template <class Arm>
void RetractRequest<Arm>::join(std::uint64_t tick, const Joints<Arm>& joint_rad) {
  if (!path_.empty()) {
    const auto apart_m = [&](std::size_t i) {
      return ArmTraits<Arm>::apart_m(table_, path_.at(i).joint_rad, joint_rad);
    };
    const std::size_t newest = path_.size() - 1, nearest = path_.nearest(joint_rad);
    const std::size_t place = apart_m(newest) <= apart_m(nearest) + kSamePlace_m ? newest : nearest;
    const double distance_m = apart_m(place);
    if (distance_m <= kJoin_m) {
      path_.keep(place + 1);
      tell(event::RetractEvent::kKept, place, distance_m,
           "the way back is kept: " + count_text(place) + ", the arm " + mm_text(distance_m) + " beside it");
    } else {
      why_lost_ = ": the one before was given up, as the arm was enabled " + mm_text(distance_m) +
                  " beside it, allowed " + mm_text(kJoin_m);
      tell(event::RetractEvent::kLost, path_.size(), distance_m,
           "the way back is given up: the arm is enabled " + mm_text(distance_m) + " beside it, allowed " +
               mm_text(kJoin_m));
      path_.clear();
    }
  }
  path_.begin(tick, joint_rad);
}

template <class Arm>
void RetractRequest<Arm>::end(const std::string& why, const Joints<Arm>& joint_rad) {
  const std::size_t left = points_left();
  const bool too_short = why.empty() && until_tick_ > 0 && path_.at(0).tick > until_tick_;
  retract_ = {RetractPhase::kDone, left, retract_.points,
              too_short ? "the path does not lead farther back" + why_lost_ : why};
  done_rad_ = joint_rad;
  if (retract_.reason.empty()) return tell(event::RetractEvent::kArrives, left, 0.0, "retract: the arm is back");
  retract_.phase = RetractPhase::kEnded;
  tell(event::RetractEvent::kEnds, left, 0.0, "retract: ended with " + count_text(left) + " to go: " + retract_.reason);
}

}  // namespace liana::arbiter
