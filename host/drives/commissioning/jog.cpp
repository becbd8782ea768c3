#include "host/drives/commissioning/jog.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace liana::commissioning {
namespace {

constexpr double kEnable_s = 5.0;
constexpr double kSettle_s = 2.0;
constexpr double kSettled_s = 0.1;  // at its goal so long
constexpr double kDisable_s = 2.0;
constexpr double kQuickStop_s = 1.0;  // of it
constexpr double kReports_s = 0.1;
constexpr double kStrained_s = 0.1;
constexpr double kStrained = 1.25;  // of the torque that it may have: a drive that limits it stays below
constexpr double kHeartbeat_s = 0.35;

// Nothing beyond what 607A can say.
std::int32_t counts_at(double counts) {
  return static_cast<std::int32_t>(std::clamp(counts, -2147483648.0, 2147483647.0));
}

}  // namespace

bool JogBounds::allows(std::int32_t before, std::int64_t target) const noexcept {
  const double step = std::fabs(static_cast<double>(target) - before);
  return target >= low && target <= high && step <= max_step;
}

Jog::Jog(const JogRequest& request, double rate_hz) : request_(request), rate_hz_(rate_hz) {}

std::int32_t Jog::moved_counts() const noexcept { return was_enabled_ ? moved_to_ - start_ : 0; }

void Jog::enter(Phase phase) noexcept {
  phase_ = phase;
  in_phase_ticks_ = 0;
}

// The first reason is the one that is told.
void Jog::end_with(JogResult why, Phase next) noexcept {
  if (end_ == JogResult::kNone) end_ = why;
  enter(next);
}

void Jog::interrupt() noexcept {
  const bool moves = phase_ == Phase::kMove || phase_ == Phase::kSettle;
  if (phase_ == Phase::kDisable || phase_ == Phase::kOver) return;
  end_with(JogResult::kInterrupted, moves ? Phase::kStop : Phase::kDisable);
}

DriveGoal Jog::goal() const noexcept {
  const DriveState state = decode(last_.statusword);
  switch (phase_) {
    case Phase::kEnable:
      if (state == DriveState::kFault) return DriveGoal::kFaultReset;
      return DriveGoal::kOperationEnabled;
    case Phase::kMove:
    case Phase::kSettle:
    case Phase::kStop:
      return DriveGoal::kOperationEnabled;
    case Phase::kDisable:
    case Phase::kOver:
      break;
  }
  // A motor that turns is stopped by its ramp before the brake takes it. A drive whose 605A is none of ours may stay in
  // Quick stop active: then it is disabled.
  const bool stops_first = has_torque(state) && end_ != JogResult::kArrived && in_phase_ticks_ < ticks(kQuickStop_s);
  return stops_first ? DriveGoal::kQuickStop : DriveGoal::kDisabled;
}

DriveCommand Jog::step(const DriveFeedback& seen) noexcept {
  last_ = seen;
  ++in_phase_ticks_;
  if (was_enabled_ && seen.feedback_age_ticks == 0) moved_to_ = seen.position_counts;
  switch (phase_) {
    case Phase::kEnable:
      enable();
      break;
    case Phase::kMove:
    case Phase::kStop:
      watch();
      if (phase_ == Phase::kMove || phase_ == Phase::kStop) move();
      break;
    case Phase::kSettle:
      watch();
      if (phase_ == Phase::kSettle) settle();
      break;
    case Phase::kDisable:
      disable();
      break;
    case Phase::kOver:
      break;
  }
  told_.controlword = controlword_for(decode(last_.statusword), goal(), told_.controlword);
  return told_;
}

// The target follows the motor until it is enabled, so that it does not jump.
void Jog::enable() noexcept {
  const DriveState state = decode(last_.statusword);
  if (last_.feedback_age_ticks == 0) told_.target_counts = last_.position_counts;
  if (state == DriveState::kFault && !request_.clears_fault && last_.feedback_age_ticks == 0)
    return end_with(JogResult::kFaultBefore, Phase::kDisable);
  if (in_phase_ticks_ > ticks(kEnable_s)) return end_with(JogResult::kNotEnabled, Phase::kDisable);
  if (state != DriveState::kOperationEnabled || last_.feedback_age_ticks != 0) return;
  start_ = moved_to_ = last_.position_counts;
  was_enabled_ = true;
  target_ = start_;
  const double way = std::round(request_.by_counts);
  bounds_ = {counts_at(start_ + std::min(way, 0.0)), counts_at(start_ + std::max(way, 0.0)),
             request_.counts_per_s / rate_hz_ + 1.0};
  enter(Phase::kMove);
}

void Jog::watch() noexcept {
  const bool left = last_.feedback_age_ticks == 0 && decode(last_.statusword) != DriveState::kOperationEnabled;
  const double away = std::fabs(static_cast<double>(last_.position_counts) - told_.target_counts);
  if (left) return end_with(JogResult::kFault, Phase::kDisable);
  if (last_.emergency_code != 0) return end_with(JogResult::kEmergency, Phase::kDisable);
  if (last_.feedback_age_ticks > ticks(kReports_s)) return end_with(JogResult::kReportsLost, Phase::kDisable);
  if (last_.heartbeat_age_ticks > ticks(kHeartbeat_s) || last_.operational == 0)
    return end_with(JogResult::kHeartbeatLost, Phase::kDisable);
  if (last_.operational == kInOtherMode) return end_with(JogResult::kOtherMode, Phase::kDisable);
  const bool is_strained = std::abs(last_.torque_permille) > kStrained * request_.most_torque_permille;
  strained_ticks_ = is_strained ? strained_ticks_ + 1 : 0;
  if (strained_ticks_ > ticks(kStrained_s)) return end_with(JogResult::kTorque, Phase::kDisable);
  if (away > request_.window_counts) return end_with(JogResult::kRanAway, Phase::kDisable);
}

// Speed goes up and down by the ramp; it is never more than what can be braked on the way that is left.
void Jog::move() noexcept {
  const double slope = request_.counts_per_s / request_.ramp_s, tick_s = 1.0 / rate_hz_;
  const double left = std::fabs(start_ + request_.by_counts - target_);
  const double half_tick = 0.5 * slope * tick_s;  // speed changes in steps of a tick
  const double brakes_in_time = std::sqrt(2.0 * slope * left + half_tick * half_tick) - half_tick;
  const double wanted = phase_ == Phase::kStop ? 0.0 : std::min(request_.counts_per_s, brakes_in_time);
  speed_ = std::clamp(wanted, speed_ - slope * tick_s, speed_ + slope * tick_s);
  const double step = std::min(speed_ * tick_s, left);
  tell_target(target_ + std::copysign(step, request_.by_counts));
  if (phase_ == Phase::kStop && speed_ <= 0.0) return end_with(end_, Phase::kDisable);
  if (phase_ == Phase::kMove && left - step < 0.5) {
    tell_target(start_ + std::round(request_.by_counts));
    if (phase_ == Phase::kMove) enter(Phase::kSettle);
  }
}

void Jog::tell_target(double target) noexcept {
  const auto counts = static_cast<std::int64_t>(std::llround(target));
  if (!bounds_.allows(told_.target_counts, counts)) return end_with(JogResult::kBounds, Phase::kDisable);
  target_ = target;
  told_.target_counts = static_cast<std::int32_t>(counts);
}

void Jog::settle() noexcept {
  if (in_phase_ticks_ > ticks(kSettle_s)) return end_with(JogResult::kNotSettled, Phase::kDisable);
  const double away = std::fabs(static_cast<double>(last_.position_counts) - told_.target_counts);
  const bool has_settled = away <= request_.settled_counts && in_phase_ticks_ > ticks(kSettled_s);
  if (has_settled) end_with(JogResult::kArrived, Phase::kDisable);
}

void Jog::disable() noexcept {
  const DriveState state = decode(last_.statusword);
  const bool is_done = state == DriveState::kSwitchOnDisabled || state == DriveState::kFault;
  if ((is_done && last_.feedback_age_ticks == 0) || in_phase_ticks_ > ticks(kDisable_s)) enter(Phase::kOver);
}

}  // namespace liana::commissioning
