#include "host/arbiter/device_steer.hpp"

#include <algorithm>

namespace liana::arbiter {

using namespace cable;

void DeviceSteer::use(const DeviceUse& use) {
  if (rate_.count() > 0) ended_use_ = UseRecord{use_.name, rate_};
  use_ = use;
  rate_ = device::SampleRate{};
  tip_age_.forget();
  node_age_.forget();
  tip_ = HandTrack{};
  node_ = HandTrack{};
  tip_coast_.forget();
  node_coast_.forget();
  engaged_ = node_engaged_ = must_let_go_ = false;
  silent_s_ = 0.0;
  newest_us_ = made_of_us_ = oldest_us_ = made_from_us_ = -1;
  came_ = 0;
  node_target_ = NodeTarget{};
  reason_ = "";
}

void DeviceSteer::add(const device::Sample& sample) {
  if (sample.hand != 0) return node_age_.add(sample);
  tip_age_.add(sample);
  rate_.add(sample.t_us);
  ++came_;
}

void DeviceSteer::take_in(const device::Sample& tip) {
  tip_.add_sample(tip);
  newest_us_ = std::max(newest_us_, tip.t_us);
  if (!std::exchange(interval_has_samples_, true)) oldest_us_ = tip.t_us;
}

void DeviceSteer::lose_device() {
  disengage("device gone");
  tip_age_.forget();
  node_age_.forget();
  tip_ = HandTrack{};
  node_ = HandTrack{};
  node_engaged_ = false;
  newest_us_ = made_of_us_ = oldest_us_ = made_from_us_ = -1;
}

void DeviceSteer::disengage(const char* reason) {
  tip_coast_.forget();
  if (engaged_) reason_ = reason;
  engaged_ = false;
  must_let_go_ = true;
}

// The node target follows the left hand while its trigger is closed, and stays where it was put when it is let go.
void DeviceSteer::steer_node(const HandReading& left, const cable::Outputs& now, double interval_s) {
  const bool held = use_.node > 0 && left.pressed && !left.let_go && !left.lost;
  node_engaged_ = node_engaged_ && held;
  if (!held) return node_coast_.forget();
  if (!left.has_mean && !node_engaged_) return;
  if (left.has_mean) node_coast_.see(left.mean, interval_s);
  const Pose& hand = left.has_mean ? left.mean : node_coast_.go_on(interval_s);
  if (!node_engaged_) {
    node_engaged_ = true;
    node_hand_anchor_m_ = hand.position_m;
    node_anchor_m_ = node_target_.node == use_.node ? node_target_.position_m
                                                    : now.node_command_m[static_cast<std::size_t>(use_.node - 1)];
  }
  node_target_ = {use_.node, clutch_point(use_.mapping.scale, node_hand_anchor_m_, node_anchor_m_, hand.position_m),
                  1.0, kNodeThreshold_m};
}

std::optional<SteerGoal> DeviceSteer::finish_interval(const cable::Outputs& now, double interval_s) {
  for (const device::Sample& sample : tip_age_.finish_interval(interval_s)) take_in(sample);
  for (const device::Sample& sample : node_age_.finish_interval(interval_s)) node_.add_sample(sample);
  const HandReading tip = tip_.finish_interval();
  const HandReading left = node_.finish_interval();
  interval_has_samples_ = false;
  if (use_.kind == device::Kind::kNone) return std::nullopt;
  const std::uint64_t came = std::exchange(came_, 0);
  samples_ += came;
  rate_.finish_interval(interval_s);
  silent_s_ = came > 0 ? 0.0 : silent_s_ + interval_s;

  if (tip.let_go) {
    tip_coast_.forget();
    engaged_ = must_let_go_ = false;
    reason_ = "";
  }
  if (tip.lost) disengage("tracking lost");
  if (silent_s_ > kDeviceSilent_s) disengage("device silent");
  steer_node(left, now, interval_s);
  if (!tip.pressed || must_let_go_) return std::nullopt;
  if (tip.has_mean) {
    hand_ = tip.mean;
    tip_coast_.see(hand_, interval_s);
    if (!engaged_) anchor_ = {hand_, now.tip_command};
    engaged_ = true;
  }
  if (!engaged_) return std::nullopt;
  if (!tip.has_mean) hand_ = tip_coast_.go_on(interval_s);
  const Pose goal = clutch_goal(use_.mapping, anchor_, hand_);
  move_anchor(use_.mapping, hand_, goal, anchor_);
  made_of_us_ = newest_us_;
  made_from_us_ = oldest_us_;
  return SteerGoal{goal, node_target_};
}

}  // namespace liana::arbiter
