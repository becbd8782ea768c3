// What becomes of a hand whose way was refused: the arm waits for it to turn back.
#pragma once

#include <algorithm>
#include <string_view>

#include "firmware_like/math/pose.hpp"

namespace liana::arbiter {

// A hand that pushes on would be refused in every interval, and the arm would start and stop each time. It is asked for
// again at once where it goes another way, and when that is refused waits no longer than at first; else after a while
// that doubles from refusal to refusal, and slowly. The hand keeps its place beside the tip, and loses nothing of its
// way.
class RefusalWait {
 public:
  // A goal was refused, asked for with the tip commanded to `tip`.
  void refuse(const Pose& tip, const Pose& goal) {
    refused_for_ = limit_;
    if (!goes_on(tip, goal)) wait_s_ = kFirst_s;
    shift_m_ = subtract(goal.position_m, tip.position_m);
    turn_rad_ = turn_between(tip, goal);
    left_s_ = wait_s_;
    wait_s_ = std::min(2.0 * wait_s_, kMost_s);
    share_ = kFirstShare;
    passed_s_ = 0.0;
  }
  // In place of what was refused for `limit` a slower way is tried, with `share` of the speed that was asked for.
  void slow(double share, const char* limit) {
    share_ = std::max(kLeastShare, share * share_);
    passed_s_ = 0.0;
    limit_ = limit;
  }
  // Once per interval of `dt_s`, with the hand's next goal: whether it is not asked for yet.
  bool holds(const Pose& tip, const Pose& goal, double dt_s) {
    left_s_ = goes_on(tip, goal) ? left_s_ - dt_s : 0.0;
    if (left_s_ > 0.5 * dt_s) return true;
    share_ = std::min(1.0, share_ + kRise_1_s * dt_s);
    passed_s_ += dt_s;
    if (passed_s_ > kForgotten_s) wait_s_ = kFirst_s;
    return false;
  }
  // Of the tip's speed, while it is asked for again.
  double speed_share() const { return share_; }
  // Another refusal now would be for the same limit as the one of a moment ago.
  bool stands() const { return wait_s_ > kFirst_s && std::string_view(limit_) == refused_for_; }
  // What the last refusal was for; empty: there was none.
  const char* limit() const { return limit_; }
  void forget() { *this = {}; }

 private:
  static constexpr double kFirst_s = 0.2, kMost_s = 6.4;
  static constexpr double kFirstShare = 0.3, kLeastShare = 0.1, kRise_1_s = 0.5;
  static constexpr double kForgotten_s = 3.0;  // without another refusal
  static constexpr double kSame = 0.3;         // of the way that was refused
  static constexpr double kLeast_m = 0.001, kLeast_rad = 0.01;

  static Vec3 turn_between(const Pose& from, const Pose& to) {
    return rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
  }
  bool goes_on(const Pose& tip, const Pose& goal) const {
    const bool shifts = norm(shift_m_) > kLeast_m, turns = norm(turn_rad_) > kLeast_rad;
    if (!shifts && !turns) return true;  // it was not the tip's way that was refused
    const Vec3 shift_m = subtract(goal.position_m, tip.position_m);
    return (shifts && is_along(shift_m, shift_m_)) || (turns && is_along(turn_between(tip, goal), turn_rad_));
  }
  static bool is_along(const Vec3& way, const Vec3& refused) {
    return dot(way, refused) > kSame * dot(refused, refused);
  }

  Vec3 shift_m_{}, turn_rad_{};
  const char *limit_ = "", *refused_for_ = "";
  double left_s_ = 0.0, wait_s_ = kFirst_s, share_ = 1.0, passed_s_ = 0.0;
};

}  // namespace liana::arbiter
