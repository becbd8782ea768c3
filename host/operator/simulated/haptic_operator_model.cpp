#include "host/operator/simulated/haptic_operator_model.hpp"

#include <algorithm>
#include <cmath>

namespace liana::simulated {
namespace {

constexpr std::uint64_t kTremorPurpose = 21;
constexpr std::uint64_t kLivelyHandPurpose = 81;  // to 86
constexpr double kSampleStep_s = 0.001;
constexpr double kLongestPictureGap_s = 0.1;  // pictures further apart count as this far apart
constexpr double kSpeedMargin = 0.9;
constexpr double kMoving_m_s = 0.001;
constexpr double kRealTurn_rad = 0.05;  // a leg that turns less has no lag in attitude worth ignoring

}  // namespace

HapticOperatorModel::HapticOperatorModel(const HandGains& gains, const SlitModel& drawing, std::uint64_t seed,
                                         Temper temper)
    : gains_(temper == Temper::kLively ? in_haste(gains) : gains),
      drawing_(drawing),
      tremor_(gains.tremor_m, gains.tremor_rad, seed, kTremorPurpose),
      aim_(gains_),
      grip_(gains_, drawing.slit_in_base.quaternion) {
  if (temper == Temper::kLively) lively_.emplace(LivelyTable{}, seed, kLivelyHandPurpose);
}

void HapticOperatorModel::begin(HandTask task, const HandMapping& mapping, double now_s) {
  task_ = task;
  grip_.set_mapping(mapping);
  allowed_speed_m_s_ = mapping.speed_m_s;
  goals_.clear();
  pictures_.clear();  // what was seen before belongs to another tip pose
  last_picture_s_ = now_s;
  enter(Phase::kLooking, now_s);
}

void HapticOperatorModel::enter(Phase phase, double now_s) {
  phase_ = phase;
  phase_since_s_ = now_s;
  if (phase == Phase::kReturning) grip_.start_return(leg_.remaining());
  if (phase == Phase::kReturning || phase == Phase::kLooking) {
    looks_ = 0;
    has_slipped_ = false;
  }
  if (phase == Phase::kGripping) grip_.grip(aim_.commanded());
  followed_s_ = good_since_s_ = now_s;
}

bool HapticOperatorModel::button() const {
  return phase_ == Phase::kGripping || phase_ == Phase::kSteering || phase_ == Phase::kSettling;
}

void HapticOperatorModel::look(const TipObservation& sighting, double now_s) {
  if (phase_ == Phase::kIdle || phase_ == Phase::kDone) return;
  pictures_.push_back({now_s + gains_.reaction_s, sighting});
}

void HapticOperatorModel::feel(bool engaged, double now_s) {
  if (engaged || !button()) followed_s_ = now_s;
}

// The plan, from where the tip is seen. Inside the slit the way in is already behind.
void HapticOperatorModel::plan(const Pose& seen_tip) {
  const Quat& heading = drawing_.rod_in_slit.quaternion;  // the rod's attitude already lies in the slit plane
  const double depth_m = seen_tip.position_m[0];
  if (task_ == HandTask::kEnterSlit) {
    const Pose approach{{-gains_.approach_before_mouth_m, 0.0, gains_.approach_z_m}, heading};
    if (depth_m < -gains_.slow_before_mouth_m)
      goals_.push_back({approach, gains_.align_m, gains_.align_rad, gains_.align_dwell_s, gains_.align_relent_most,
                        gains_.align_at_last});
    goals_.push_back({{{gains_.switch_depth_m, 0.0, gains_.switch_z_m}, heading},
                      gains_.depth_m,
                      gains_.align_rad,
                      gains_.align_dwell_s,
                      gains_.relent_most});
  } else {
    goals_.push_back({drawing_.rod_in_slit, gains_.fine_m, gains_.fine_rad, gains_.fine_dwell_s, gains_.relent_most});
  }
  goal_index_ = 0;
  aim_.reset(seen_tip);
  start_leg(seen_tip);
}

// The way goes on from where the tip has come to rest; what slipped on letting go is simply still ahead.
void HapticOperatorModel::go_on(double now_s) {
  if (looks_ > 0) {
    aim_.reset(rest_tip_);
    start_leg(rest_tip_);
  }
  enter(Phase::kGripping, now_s);
}

// A little slower than allowed, so that the arm does not fall behind.
LegPace HapticOperatorModel::pace() const {
  const double most = allowed_speed_m_s_ > 0.0 ? kSpeedMargin * allowed_speed_m_s_ : gains_.free_speed_m_s;
  return {std::min(gains_.free_speed_m_s, most), std::min(gains_.slit_speed_m_s, most), -gains_.slow_before_mouth_m,
          gains_.turn_rate_rad_s, gains_.accel_m_s2};
}

void HapticOperatorModel::start_leg(const Pose& from) {
  const Pose& goal = goals_[goal_index_].tip_in_slit;
  leg_ = Leg(from, goal, pace());
  judged_ = step_between(goal, from);
}

void HapticOperatorModel::perceive(double now_s) {
  while (!pictures_.empty() && pictures_.front().due_s <= now_s) {
    const auto tip = tip_in_slit(drawing_, pictures_.front().sighting, task_ == HandTask::kReachRod);
    if (tip) take_in(*tip, now_s);
    pictures_.pop_front();
  }
}

void HapticOperatorModel::take_in(const Pose& seen_tip, double now_s) {
  const double since_last_s = std::min(now_s - last_picture_s_, kLongestPictureGap_s);
  last_picture_s_ = now_s;
  if (phase_ == Phase::kLooking || phase_ == Phase::kReturning) return rest_eyes(seen_tip, now_s);
  if (phase_ != Phase::kSteering && phase_ != Phase::kSettling) return;  // correcting is the gripping hand's business
  aim_.see(seen_tip, since_last_s, lag_directions(now_s));
  judge(seen_tip, since_last_s);
}

// The mean of what is seen while the button is open, once the arm has come to rest.
void HapticOperatorModel::rest_eyes(const Pose& seen_tip, double now_s) {
  if (phase_ == Phase::kReturning && now_s - phase_since_s_ < gains_.arm_stops_s) return;
  ++looks_;
  const PoseStep off = step_between(rest_tip_, seen_tip);
  const double share = 1.0 / looks_;
  rest_tip_ = looks_ == 1 ? seen_tip : moved(rest_tip_, {scale(off.shift_m, share), scale(off.turn_rad, share)});
}

void HapticOperatorModel::judge(const Pose& seen_tip, double since_last_s) {
  const PoseStep error = step_between(goals_[goal_index_].tip_in_slit, seen_tip);
  const double share = since_last_s / (gains_.judge_tau_s + since_last_s);
  judged_.shift_m = add(judged_.shift_m, scale(subtract(error.shift_m, judged_.shift_m), share));
  judged_.turn_rad = add(judged_.turn_rad, scale(subtract(error.turn_rad, judged_.turn_rad), share));
}

PoseStep HapticOperatorModel::lag_directions(double now_s) const {
  if (now_s - last_moving_s_ >= gains_.along_quiet_s) return {};
  PoseStep along = leg_.whole();
  if (norm(along.turn_rad) < kRealTurn_rad) along.turn_rad = {};
  return along;
}

double HapticOperatorModel::eagerness(double now_s) const {
  if (phase_ != Phase::kSteering || now_s - last_picture_s_ > gains_.blind_s) return 0.0;
  return std::clamp((gains_.wait_full_m - aim_.surprise_m()) / (gains_.wait_full_m - gains_.wait_from_m), 0.0, 1.0);
}

bool HapticOperatorModel::is_behind() const { return aim_.surprise_m() > gains_.settled_m; }

void HapticOperatorModel::look_around(double now_s) {
  if (now_s - phase_since_s_ < gains_.look_s || looks_ == 0) return;
  plan(rest_tip_);
  enter(Phase::kReturning, now_s);
}

void HapticOperatorModel::steer(double now_s) {
  leg_.walk(kSampleStep_s, eagerness(now_s));
  if (leg_.share_per_s() * norm(leg_.whole().shift_m) > kMoving_m_s) last_moving_s_ = now_s;
  aim_.advance(leg_.pose(), kSampleStep_s);
  grip_.follow(aim_.commanded());
}

void HapticOperatorModel::watch_goal(double now_s) {
  const Goal& goal = goals_[goal_index_];
  if (!leg_.finished()) striving_since_s_ = now_s;
  const double striving_s = now_s - striving_since_s_;
  double relent = std::min(1.0 + striving_s / gains_.relent_s, goal.relent_most);
  relent = std::max(relent, std::min(goal.relent_most + striving_s / gains_.give_in_s - 1.0, goal.at_last));
  const bool good = leg_.finished() && norm(judged_.shift_m) < relent * goal.tolerance_m &&
                    norm(judged_.turn_rad) < relent * goal.tolerance_rad;
  if (!good) good_since_s_ = now_s;
  if (now_s - good_since_s_ < goal.dwell_s) return;
  if (goal_index_ + 1 == goals_.size()) {
    enter(Phase::kLettingGo, now_s);
    return;
  }
  ++goal_index_;
  start_leg(leg_.goal());
  good_since_s_ = now_s;
}

void HapticOperatorModel::act(double now_s) {
  const double here_s = now_s - phase_since_s_;
  const double speed_m_s = leg_.share_per_s() * norm(leg_.whole().shift_m);
  const double stop_m = speed_m_s * speed_m_s / (2.0 * gains_.accel_m_s2);
  switch (phase_) {
    case Phase::kLooking:
      return look_around(now_s);
    case Phase::kReturning:
      if (grip_.advance_return(kSampleStep_s)) go_on(now_s);
      return;
    case Phase::kGripping:
      if (here_s > gains_.grip_s) enter(Phase::kSteering, now_s);
      return;
    case Phase::kSteering:
      steer(now_s);
      if (now_s - followed_s_ > gains_.patience_s) return enter(Phase::kReturning, now_s);
      if (grip_.out_of_reach(leg_.remaining(), stop_m)) return enter(Phase::kSettling, now_s);
      return watch_goal(now_s);
    case Phase::kSettling:
      steer(now_s);
      if (!leg_.standing()) settling_since_s_ = now_s;
      if (!leg_.standing() || (is_behind() && now_s - settling_since_s_ < gains_.settle_most_s)) phase_since_s_ = now_s;
      if (here_s > gains_.settle_s) enter(Phase::kReturning, now_s);
      return;
    case Phase::kLettingGo:
      if (here_s > gains_.settle_s) enter(Phase::kDone, now_s);
      return;
    case Phase::kIdle:
    case Phase::kDone:
      return;
  }
}

device::Sample HapticOperatorModel::sample(double now_s) {
  perceive(now_s);
  act(now_s);
  const device::Sample meant{
      .t_us = std::llround(now_s * 1e6), .deadman = button(), .pose = tremor_.apply(grip_.pose(), now_s)};
  return lively_ ? lively(meant, now_s) : meant;
}

bool HapticOperatorModel::is_aligning() const { return button() && leg_.finished(); }

// Whoever has lost the grip and found it again lets go and looks where the tip is.
device::Sample HapticOperatorModel::lively(device::Sample meant, double now_s) {
  lively_->advance(now_s, is_aligning());
  const bool has_grip = lively_->has_grip();
  if (meant.deadman && !has_grip) has_slipped_ = true;
  if (has_slipped_ && has_grip && phase_ == Phase::kSteering) enter(Phase::kReturning, now_s);
  meant.pose = lively_->right(meant.pose);
  meant.deadman = meant.deadman && has_grip;
  return meant;
}

std::optional<device::Sample> HapticOperatorModel::idle(double now_s) {
  if (!lively_) return std::nullopt;
  lively_->advance(now_s, false);
  if (!lively_->is_taken_up()) return std::nullopt;
  return device::Sample{.t_us = std::llround(now_s * 1e6), .deadman = true, .pose = lively_->right(grip_.pose())};
}

}  // namespace liana::simulated
