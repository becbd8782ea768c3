#include "host/operator/simulated/vr_operator_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/model/clearance/clearance.hpp"

namespace liana::simulated {
namespace {

constexpr std::uint64_t kRightTrackerPurpose = 51;   // and 52
constexpr std::uint64_t kLeftTrackerPurpose = 53;    // and 54
constexpr std::uint64_t kLivelyHandlesPurpose = 91;  // to 96
constexpr double kStrive_s = 2.5;                    // stands at the end of the way for so long before a stroke more
constexpr double kDecided_m = 0.05;                  // a way is followed for so long before it is doubted

HandGains hand_of(const VrGains& gains) {
  HandGains hand;
  hand.reach_m = gains.hand_reach_m;
  hand.reach_rad = gains.hand_reach_rad;
  hand.return_speed_m_s = gains.return_speed_m_s;
  return hand;
}

constexpr Quat kParallel{1.0, 0.0, 0.0, 0.0};  // wishes are in the base frame already

TrackingTable tracking_of(const VrGains& gains) {
  TrackingTable table;
  table.tremor_m = gains.tremor_m;
  table.tremor_rad = gains.tremor_rad;
  return table;
}

}  // namespace

std::optional<Pose> panel_edge(const VrGains& gains, const config::SceneConfig& drawing) {
  if (!drawing.slit) return std::nullopt;
  const Pose slit{drawing.slit->frame.position_m, drawing.slit->frame.quaternion_wxyz};
  const Pose edge =
      compose(slit, Pose{{-gains.before_mouth_m, gains.off_plane_m, gains.along_mouth_m}, {1.0, 0.0, 0.0, 0.0}});
  return Pose{edge.position_m, drawing.rod ? drawing.rod->pose.quaternion_wxyz : edge.quaternion};
}

VrOperatorModel::VrOperatorModel(const VrGains& gains, const config::SceneConfig& drawing, std::uint64_t seed,
                                 Temper temper)
    : gains_(gains),
      drawing_(drawing),
      right_(hand_of(gains), kParallel),
      left_(hand_of(gains), kParallel),
      right_tracker_(tracking_of(gains), seed, kRightTrackerPurpose),
      left_tracker_(tracking_of(gains), seed, kLeftTrackerPurpose) {
  if (temper == Temper::kLively) lively_.emplace(lively_at_handles(), seed, kLivelyHandlesPurpose);
}

void VrOperatorModel::begin(const HandMapping& mapping, double now_s) {
  right_.set_mapping(mapping);
  left_.set_mapping(mapping);
  pictures_.clear();
  seen_ = {};
  node_put_m_.reset();
  last_picture_s_ = now_s;
  enter(Phase::kLooking, now_s);
}

void VrOperatorModel::enter(Phase phase, double now_s) {
  phase_ = phase;
  phase_since_s_ = followed_s_ = there_since_s_ = striving_since_s_ = now_s;
  if (phase == Phase::kReturning) {
    has_slipped_ = false;
    node_put_m_ = node_commanded_m();
    right_.start_return(leg_.remaining());
    left_.start_return({subtract(node_to_m_, *node_put_m_), {}});
  }
  if (phase == Phase::kGripping) {
    right_.grip(leg_.pose());
    left_.grip({node_commanded_m(), kParallel});
  }
}

bool VrOperatorModel::holds() const {
  return phase_ == Phase::kGripping || phase_ == Phase::kLeading || phase_ == Phase::kSettling;
}

void VrOperatorModel::look(const ArmObservation& sight, double now_s) {
  if (phase_ == Phase::kIdle || phase_ == Phase::kDone) return;
  pictures_.push_back({now_s + gains_.reaction_s, sight});
}

void VrOperatorModel::feel(bool engaged, double now_s) {
  if (engaged || !holds()) followed_s_ = now_s;
}

void VrOperatorModel::perceive(double now_s) {
  while (!pictures_.empty() && pictures_.front().due_s <= now_s) {
    seen_ = std::move(pictures_.front().sight);
    last_picture_s_ = now_s;
    pictures_.pop_front();
  }
}

Vec3 VrOperatorModel::node_commanded_m() const {
  return add(node_from_m_, scale(subtract(node_to_m_, node_from_m_), leg_.share()));
}

// Tip and node arrive together, neither faster than it may.
void VrOperatorModel::start_leg(const Pose& from) {
  node_from_m_ = node_put_m_.value_or(seen_.node_m());
  node_to_m_ = aim().node_m;
  const double tip_m = norm(subtract(aim().tip.position_m, from.position_m));
  const double node_m = norm(subtract(node_to_m_, node_from_m_));
  const double slower = node_m > 0.0 ? std::min(1.0, tip_m * gains_.node_speed_m_s / (node_m * gains_.speed_m_s)) : 1.0;
  LegPace pace;
  pace.speed_m_s = pace.slow_speed_m_s = std::max(gains_.speed_m_s * slower, 0.1 * gains_.speed_m_s);
  pace.turn_rate_rad_s = gains_.turn_rate_rad_s;
  pace.accel_m_s2 = gains_.accel_m_s2;
  leg_ = Leg(from, aim().tip, pace);
}

void VrOperatorModel::decide() {
  way_ = plan_hands(gains_, seen_, drawing_, edge_);
  next_ = 0;
  decided_at_m_ = seen_.tip.position_m;
  room_m_ = clearance::kNoObstacle_m;
  doubts_ = false;
}

void VrOperatorModel::look_around(double now_s) {
  const auto edge = panel_edge(gains_, drawing_);
  if (now_s - phase_since_s_ < gains_.look_s || seen_.axis_m.empty() || !edge) return;
  const Vec3 turn = step_between(seen_.tip, *edge).turn_rad;
  edge_ = moved({edge->position_m, seen_.tip.quaternion}, {{}, scale(turn, gains_.turn_share)});
  decide();
  start_leg(seen_.tip);
  enter(Phase::kReturning, now_s);
}

// The hands are back; the arm has come to rest, and the way goes on from where it is seen to be.
void VrOperatorModel::come_back(double now_s) {
  const bool right_there = right_.advance_return(kSample_s), left_there = left_.advance_return(kSample_s);
  if (!right_there || !left_there || now_s - phase_since_s_ < gains_.arm_stops_s) return;
  if (doubts_) decide();
  start_leg(seen_.tip);
  enter(Phase::kGripping, now_s);
}

double VrOperatorModel::eagerness(double now_s) const {
  if (phase_ != Phase::kLeading || now_s - last_picture_s_ > gains_.blind_s) return 0.0;
  const double behind_m = norm(subtract(leg_.pose().position_m, seen_.tip.position_m));
  return std::clamp((gains_.wait_full_m - behind_m) / (gains_.wait_full_m - gains_.wait_from_m), 0.0, 1.0);
}

void VrOperatorModel::lead(double now_s) {
  leg_.walk(kSample_s, eagerness(now_s));
  if (leg_.finished() && next_ + 1 < way_.size() && phase_ == Phase::kLeading) {
    node_put_m_ = node_to_m_;
    ++next_;
    start_leg(leg_.goal());
  }
  right_.follow(leg_.pose());
  left_.follow({node_commanded_m(), kParallel});
}

// Too near something, and nearer than before, whatever was imagined; or so imagined a moment ahead from what is seen.
bool VrOperatorModel::worries() {
  const double now_m = imagined_room_m(seen_, drawing_, {{seen_.tip, seen_.node_m()}});
  const double before_m = std::exchange(room_m_, std::min(room_m_, now_m));
  if (norm(subtract(seen_.tip.position_m, decided_at_m_)) < kDecided_m) return false;
  if (now_m < gains_.worry_m && now_m < before_m) return true;
  const std::vector<HandsGoal> rest(way_.begin() + static_cast<std::ptrdiff_t>(next_), way_.end());
  const double soon_m = imagined_room_m(seen_, drawing_, rest, gains_.moment_m);
  return soon_m < gains_.worry_m && soon_m < now_m;
}

bool VrOperatorModel::out_of_reach() const {
  const double stop_m = gains_.speed_m_s * gains_.speed_m_s / (2.0 * gains_.accel_m_s2);
  return right_.out_of_reach(leg_.remaining(), stop_m) ||
         left_.out_of_reach({subtract(node_to_m_, node_commanded_m()), {}}, stop_m);
}

// At the end of the way and seen to be there: let go. Not there after a while: a stroke more, by what is seen missing.
void VrOperatorModel::watch_goal(double now_s) {
  const PoseStep missing = step_between(seen_.tip, edge_);
  const bool at_end = leg_.finished() && next_ + 1 == way_.size();
  const bool there = at_end && norm(missing.shift_m) < gains_.there_m && norm(missing.turn_rad) < gains_.there_rad;
  if (!at_end) striving_since_s_ = now_s;
  if (!there) there_since_s_ = now_s;
  if (now_s - there_since_s_ >= gains_.there_dwell_s) return enter(Phase::kLettingGo, now_s);
  if (now_s - striving_since_s_ < kStrive_s) return;
  const Pose from = leg_.pose();
  node_put_m_ = node_commanded_m();
  way_.back().tip = moved(from, missing);
  start_leg(from);
  striving_since_s_ = now_s;
}

void VrOperatorModel::act(double now_s) {
  const double here_s = now_s - phase_since_s_;
  switch (phase_) {
    case Phase::kLooking:
      return look_around(now_s);
    case Phase::kReturning:
      return come_back(now_s);
    case Phase::kGripping:
      if (here_s > gains_.grip_s) enter(Phase::kLeading, now_s);
      return;
    case Phase::kLeading:
      lead(now_s);
      if (now_s - followed_s_ > gains_.patience_s) return enter(Phase::kReturning, now_s);
      if (out_of_reach()) return enter(Phase::kSettling, now_s);
      if (worries()) {
        ++second_thoughts_;
        doubts_ = true;
        return enter(Phase::kSettling, now_s);
      }
      return watch_goal(now_s);
    case Phase::kSettling:
      lead(now_s);
      if (!leg_.standing()) phase_since_s_ = now_s;
      if (here_s > gains_.settle_s) enter(Phase::kReturning, now_s);
      return;
    case Phase::kLettingGo:
      if (here_s > gains_.arm_stops_s) enter(Phase::kDone, now_s);
      return;
    case Phase::kIdle:
    case Phase::kDone:
      return;
  }
}

BothHands VrOperatorModel::sample(double now_s) {
  perceive(now_s);
  act(now_s);
  const bool has_grip = !lively_ || keeps_grip(now_s);
  return tracked(holds() && has_grip, now_s);
}

// Whoever has lost the grip and found it again stops, lets go and decides anew. No gesture begins at the end of the
// way.
bool VrOperatorModel::keeps_grip(double now_s) {
  lively_->advance(now_s, leg_.finished() && next_ + 1 == way_.size());
  const bool has_grip = lively_->has_grip();
  if (holds() && !has_grip) has_slipped_ = true;
  if (has_slipped_ && has_grip && phase_ == Phase::kLeading) {
    doubts_ = true;
    enter(Phase::kSettling, now_s);
  }
  return has_grip;
}

BothHands VrOperatorModel::tracked(bool held, double now_s) {
  const Pose right = lively_ ? lively_->right(right_.pose()) : right_.pose();
  const Pose left = lively_ ? lively_->left(left_.pose()) : left_.pose();
  BothHands hands{right_tracker_.track(right, held, now_s), left_tracker_.track(left, held, now_s)};
  hands.left.hand = 1;
  return hands;
}

std::optional<BothHands> VrOperatorModel::idle(double now_s) {
  if (!lively_) return std::nullopt;
  lively_->advance(now_s, false);
  if (!lively_->is_taken_up()) return std::nullopt;
  return tracked(true, now_s);
}

}  // namespace liana::simulated
