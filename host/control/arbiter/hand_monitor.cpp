#include "host/control/arbiter/hand_monitor.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace liana::arbiter {

namespace {

constexpr double kVelocity_s = 0.010;     // over which a hand's velocity is averaged
constexpr double kLongestStep_s = 0.030;  // a hand that was not seen for longer is not believed to be farther off
constexpr double kStamp_s = 0.001;        // so far off is the time of a sample
// Of a tracker, and what a step may be that the tip filter makes no motion to speak of: a hand is not let go for it.
constexpr double kNoise_m = 0.005;
constexpr double kNoise_rad = 0.035;

// What stands still to the last digit is stuck where a hand cannot have stopped so: it was going at such a speed, or
// its numbers trembled, a bend of their way being this much of a step. One that slows down without a tremor is an
// emulated hand, and may stand.
constexpr double kSudden_m_s = 0.02, kSudden_rad_s = 0.2;
constexpr double kTremor = 0.5;
constexpr double kTremor_s = 0.2;     // over which bends and steps are averaged
constexpr double kTurnLever_m = 0.1;  // at which a turn counts as a way

double in_seconds(std::int64_t us) { return static_cast<double>(us) * 1e-6; }

Vec3 turn_between(const Pose& from, const Pose& to) {
  return rotation_vector(multiply(to.quaternion, conjugate(from.quaternion)));
}

// From what is between standing still and going on as before.
double beside(const Vec3& step, const Vec3& going_on) {
  const double length2 = dot(going_on, going_on);
  const double share = length2 > 0.0 ? std::clamp(dot(step, going_on) / length2, 0.0, 1.0) : 0.0;
  return norm(subtract(step, scale(going_on, share)));
}

// How far beside it comes whoever speeds up by `accel` for dt_s: its velocity is known as it was kVelocity_s ago.
double reach(double accel, double dt_s, double speed) {
  return accel * dt_s * (std::max(kVelocity_s, 0.5 * dt_s) + 0.5 * dt_s) + speed * kStamp_s;
}

}  // namespace

HandLimits limits_of(device::Kind kind) {
  if (kind != device::Kind::kPointer) return {};
  constexpr double kAtOnce = std::numeric_limits<double>::infinity();
  return {1.1, 5.5, kAtOnce, kAtOnce, false};
}

bool HandMonitor::leads_to(const Track& from, const device::Sample& to) const {
  const double dt_s = in_seconds(to.t_us - from.t_us), short_s = std::min(dt_s, kLongestStep_s);
  const Vec3 way_m = subtract(to.pose.position_m, from.pose.position_m);
  const Vec3 turn_rad = turn_between(from.pose, to.pose);
  const double most_s = from.is_moving_known ? dt_s : short_s;
  if (norm(way_m) > kNoise_m + limits_.speed_m_s * most_s) return false;
  if (norm(turn_rad) > kNoise_rad + limits_.turn_rad_s * most_s) return false;
  if (!from.is_moving_known) return true;
  return beside(way_m, scale(from.velocity_m_s, dt_s)) <=
             kNoise_m + reach(limits_.accel_m_s2, short_s, norm(from.velocity_m_s)) &&
         beside(turn_rad, scale(from.rate_rad_s, dt_s)) <=
             kNoise_rad + reach(limits_.turn_accel_rad_s2, short_s, norm(from.rate_rad_s));
}

void HandMonitor::follow(const device::Sample& sample) {
  const double dt_s = in_seconds(sample.t_us - hand_->t_us);
  const double share = hand_->is_moving_known ? std::min(1.0, dt_s / kVelocity_s) : 1.0;
  const auto nearer = [share](const Vec3& from, const Vec3& to) { return add(from, scale(subtract(to, from), share)); };
  const Vec3 way_m = subtract(sample.pose.position_m, hand_->pose.position_m);
  const Vec3 turn_rad = turn_between(hand_->pose, sample.pose);
  note_tremor(scale(way_m, 1.0 / dt_s), scale(turn_rad, 1.0 / dt_s), dt_s);
  hand_->velocity_m_s = nearer(hand_->velocity_m_s, scale(way_m, 1.0 / dt_s));
  hand_->rate_rad_s = nearer(hand_->rate_rad_s, scale(turn_rad, 1.0 / dt_s));
  hand_->is_moving_known = true;
  hand_->pose = sample.pose;
  hand_->t_us = sample.t_us;
}

void HandMonitor::note_tremor(const Vec3& velocity_m_s, const Vec3& rate_rad_s, double dt_s) {
  const double share = std::min(1.0, dt_s / kTremor_s);
  const auto size = [](const Vec3& way, const Vec3& turn) { return norm(way) + kTurnLever_m * norm(turn); };
  const double step = size(velocity_m_s, rate_rad_s);
  const double bend = size(subtract(velocity_m_s, hand_->step_m_s), subtract(rate_rad_s, hand_->step_rad_s));
  hand_->steps += share * (step - hand_->steps);
  hand_->bends += share * (bend - hand_->bends);
  hand_->step_m_s = velocity_m_s;
  hand_->step_rad_s = rate_rad_s;
}

bool HandMonitor::could_not_stop() const {
  return norm(hand_->velocity_m_s) > kSudden_m_s || norm(hand_->rate_rad_s) > kSudden_rad_s ||
         hand_->bends > kTremor * hand_->steps;
}

bool HandMonitor::is_stuck(const device::Sample& sample) {
  const bool is_same =
      sample.pose.position_m == hand_->pose.position_m && sample.pose.quaternion == hand_->pose.quaternion;
  if (!is_same && !same_from_us_) return false;
  if (is_same && (same_from_us_ || (hand_->t_us - varies_from_us_ >= kProof_us && could_not_stop()))) {
    if (!same_from_us_) same_from_us_ = hand_->t_us;
    return limits_.trembles && sample.t_us - *same_from_us_ >= kStuck_us;
  }
  same_from_us_.reset();
  varies_from_us_ = sample.t_us;
  return false;
}

HandMonitor::Finding HandMonitor::judge(const device::Sample& sample) {
  if (!sample.valid || !is_valid(sample.pose)) return Finding::kUnseen;
  if (hand_ && sample.t_us <= hand_->t_us) return Finding::kUnseen;
  const bool is_led = std::exchange(is_held_, sample.deadman) && sample.deadman;
  if (!hand_) varies_from_us_ = sample.t_us;
  const Finding finding = hand_ && is_led ? judge_held(sample) : Finding::kHand;
  if (finding == Finding::kDoubtful) return finding;
  const bool is_anew = !hand_ || finding == Finding::kJumped || (!is_led && !leads_to(*hand_, sample));
  if (hand_ && !is_led) is_stuck(sample);
  if (is_anew) {
    hand_ = Track{sample.pose, sample.t_us, {}, {}, false, {}, {}, 0.0, 0.0};
  } else {
    follow(sample);
  }
  doubt_.reset();
  return finding;
}

// One that stays where it has jumped to goes on from there as the hand went.
HandMonitor::Finding HandMonitor::judge_held(const device::Sample& sample) {
  if (doubt_ && leads_to(*doubt_, sample)) return Finding::kJumped;
  if (leads_to(*hand_, sample)) return is_stuck(sample) ? Finding::kStuck : Finding::kHand;
  if (!doubt_) doubt_from_us_ = sample.t_us;
  if (sample.t_us - doubt_from_us_ > kDoubt_us) return Finding::kJumped;
  doubt_ = *hand_;
  doubt_->pose = sample.pose;
  doubt_->t_us = sample.t_us;
  return Finding::kDoubtful;
}

}  // namespace liana::arbiter
