#include "host/control/arbiter/teleop_input.hpp"

#include <algorithm>
#include <cmath>

namespace liana::arbiter {

using namespace cable;

void TeleopInput::use(const DeviceUse& use) {
  if (rate_.count() > 0) ended_use_ = UseRecord{use_.name, rate_};
  use_ = use;
  rate_ = device::SampleRate{};
  begin_anew();
  tip_coast_.forget();
  node_coast_.forget();
  engaged_ = require_reengage_ = node_must_let_go_ = false;
  silent_s_ = 0.0;
  came_ = 0;
  node_target_ = NodeTarget{};
  reason_ = "";
}

// With another device, and another clock.
void TeleopInput::begin_anew() {
  tip_age_.forget();
  node_age_.forget();
  tip_ = HandTrack{};
  node_ = HandTrack{};
  tip_watch_ = node_watch_ = HandMonitor(limits_of(use_.kind));
  tip_lie_ = node_lie_ = nullptr;
  node_engaged_ = false;
  newest_us_ = made_of_us_ = oldest_us_ = made_from_us_ = told_us_ = -1;
  refused_ = 0;
}

// Nothing where a hand may be so; a sample that says something else leads nothing.
const char* TeleopInput::lie_of(HandMonitor& watch, device::Sample& sample) const {
  const HandMonitor::Finding finding = watch.judge(sample);
  const char* lie = nullptr;
  if (finding == HandMonitor::Finding::kJumped) lie = "hand jumped";
  if (finding == HandMonitor::Finding::kStuck) lie = "values stuck";
  if (sample.stale) lie = "input stale";
  if (lie != nullptr || finding == HandMonitor::Finding::kDoubtful) sample.valid = false;
  return lie;
}

bool TeleopInput::is_clock_set(const device::Sample& tip) const {
  if (told_us_ < 0) return false;
  return static_cast<double>((tip.t_us - told_us_) - (arm_us_ - heard_us_)) * 1e-6 > kClockStep_s;
}

void TeleopInput::add(const device::Sample& sample) {
  device::Sample judged = sample;
  if (sample.hand != 0) {
    if (const char* lie = lie_of(node_watch_, judged)) node_lie_ = lie;
    return node_age_.add(judged);
  }
  if (is_clock_set(sample)) tip_lie_ = "clock set";
  if (const char* lie = lie_of(tip_watch_, judged)) tip_lie_ = lie;
  told_us_ = sample.t_us;
  heard_us_ = arm_us_;
  tip_age_.add(judged);
  rate_.add(sample.t_us);
  ++came_;
}

void TeleopInput::take_in(const device::Sample& tip) {
  tip_.add_sample(tip);
  newest_us_ = std::max(newest_us_, tip.t_us);
  if (!std::exchange(interval_has_samples_, true)) oldest_us_ = tip.t_us;
}

void TeleopInput::lose_device() {
  disengage("device gone");
  begin_anew();
}

void TeleopInput::disengage(const char* reason) {
  tip_coast_.forget();
  if (engaged_) reason_ = reason;
  engaged_ = false;
  require_reengage_ = true;
}

// What is wrong with the device's own words comes before what its deadman says: a puck that is silent has let go, too.
void TeleopInput::watch_tip(const HandReading& tip, std::uint64_t came, double interval_s) {
  silent_s_ = came > 0 ? 0.0 : silent_s_ + interval_s;
  const char* lie = std::exchange(tip_lie_, nullptr);
  if (lie != nullptr) disengage(lie);
  if (tip.let_go) {
    tip_coast_.forget();
    engaged_ = require_reengage_ = false;
    if (lie == nullptr) reason_ = "";
  }
  if (tip.lost) disengage("tracking lost");
  if (tip_age_.is_late()) disengage("input late");
  // The last sample may have come at the begin of its interval.
  if (silent_s_ + 1.5 * interval_s > kDeviceSilent_s) disengage(refused_ > 0 ? "samples refused" : "device silent");
  if (came > 0) refused_ = 0;
}

// The node target follows the left hand while its trigger is closed, and stays where it was put when it is let go.
void TeleopInput::steer_node(const HandReading& left, const cable::Outputs& now, double interval_s) {
  const char* lie = std::exchange(node_lie_, nullptr);
  node_must_let_go_ = lie != nullptr || (node_must_let_go_ && !left.let_go);
  const bool held = use_.node > 0 && left.pressed && !left.let_go && !left.lost && !node_must_let_go_;
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

std::optional<TeleopGoal> TeleopInput::finish_interval(const cable::Outputs& now, double interval_s) {
  arm_us_ += std::llround(1e6 * interval_s);
  for (const device::Sample& sample : tip_age_.finish_interval(interval_s)) take_in(sample);
  for (const device::Sample& sample : node_age_.finish_interval(interval_s)) node_.add_sample(sample);
  const HandReading tip = tip_.finish_interval();
  const HandReading left = node_.finish_interval();
  interval_has_samples_ = false;
  if (use_.kind == device::Kind::kNone) return std::nullopt;
  const std::uint64_t came = std::exchange(came_, 0);
  samples_ += came;
  rate_.finish_interval(interval_s);
  watch_tip(tip, came, interval_s);
  steer_node(left, now, interval_s);
  if (!tip.pressed || require_reengage_) return std::nullopt;
  if (tip.has_mean) {
    hand_ = tip.mean;
    tip_coast_.see(hand_, interval_s);
    if (!engaged_) clutch_.engage(hand_, now.tip_command);
    engaged_ = true;
  }
  if (!engaged_) return std::nullopt;
  if (!tip.has_mean) hand_ = tip_coast_.go_on(interval_s);
  made_of_us_ = newest_us_;
  made_from_us_ = oldest_us_;
  return TeleopGoal{clutch_.follow(use_.mapping, hand_, now.tip_command), node_target_};
}

}  // namespace liana::arbiter
