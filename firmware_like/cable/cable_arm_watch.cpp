// What a cable arm watches of itself beyond each drive: its cables among each other, and the balance of their torques.
#include "firmware_like/cable/arm/sparing.hpp"
#include "firmware_like/cable/cable_arm.hpp"
#include "firmware_like/math/convert.hpp"
#include "firmware_like/math/pair.hpp"
#include "firmware_like/math/scalar.hpp"

namespace liana::cable {
namespace {

std::uint16_t detail_of(double number) noexcept {
  return narrow<std::uint16_t>(to_counts(smaller(number, 65535.0)).value);
}

// Readings of this cable are known to jump about: that one is low says nothing of it.
bool scatters(const FaultList& faults, std::int32_t cable) noexcept {
  for (std::int32_t i = 0; i < faults.count; ++i) {
    const Fault& fault = faults.fault[as_index(i)];
    if (fault.number == FaultNumber::kTensionScatters && fault.index == cable) return true;
  }
  return false;
}

// What is latched leaves tensions to be believed: the balance found it itself, or it is what a contact does to cables.
bool leaves_balance(FaultNumber number) noexcept {
  return number == FaultNumber::kBodyContact || number == FaultNumber::kFrictionNotAsDeclared ||
         number == FaultNumber::kCableSlack || number == FaultNumber::kTensionAlarm;
}

// It is about torques or about lengths: a cable that is loose by its tension is wound in all the same.
bool leaves_tensions(const FaultList& faults) noexcept {
  bool leaves = faults.dropped == 0;
  for (std::int32_t i = 0; i < faults.count; ++i) {
    const FaultNumber number = faults.fault[as_index(i)].number;
    leaves = leaves && (number == FaultNumber::kBodyContact || number == FaultNumber::kFrictionNotAsDeclared ||
                        number == FaultNumber::kHomingImplausible);
  }
  return leaves;
}

}  // namespace

void CableArm::watch(WatchScope scope, std::uint64_t tick, FaultList& faults) noexcept {
  const CableReadings cables{payout_measured_m_, tension_measured_N_, model_.geometry.length_m, estimator_.residual_m};
  watch_missed(tick, faults);
  const bool retracts = motion_.to.kind == CommandKind::kRetract && !motion_.braking;
  if (retracts && faults.count > 0) spare_cables(table_, layout_, faults, lift_N_);
  winds_in_ = leaves_tensions(faults) && (!is_let_go(let_go_) || does_without(let_go_));
  const bool usable = scope.prepared && feedback_age_ticks_ == 0 && faults.count == 0 && !is_let_go(let_go_);
  watch_cables(table_, cable_watch_limits_, cables, usable, tick, cable_watch_, faults);
  if (scope.prepared) {
    if (feedback_age_ticks_ == 0 && !is_let_go(let_go_)) watch_balance(tick, faults);
  } else {
    forget_balance();
  }
}

// What was found of friction stays.
void CableArm::forget_balance() noexcept {
  friction_ = FrictionEstimatorState{friction_.mu, friction_.variance, 0, friction_.flagged};
  reset_balance(model_.geometry, slip_, balance_);
  contact_ = ContactDetectorState{};
  inertia_ = BodyInertiaState{};
}

void CableArm::watch_balance(std::uint64_t tick, const FaultList& faults) noexcept {
  for (std::int32_t i = 0; i < faults.count; ++i) {
    if (!leaves_balance(faults.fault[as_index(i)].number)) {
      forget_balance();
      return;
    }
  }
  // One axis in a tick; when all have been looked at, what they say together half a period later; between them the
  // places of a contact, one in a tick.
  const auto phase = static_cast<std::uint32_t>(tick % kFrictionTicks);
  if (phase == 0) {
    balance_next_axis(tick);
  } else if (phase == kFrictionTicks / 2) {
    if (friction_.axis != 0 || !balance_.whole) return;
    end_round(table_, torque_limits_, balance_);
    watch_contact(table_, motion_.arm, balance_, {is_moving(), is_dithering(dither_)}, contact_);
  } else {
    const std::uint32_t slots = (kFrictionTicks - 2) * narrow<std::uint32_t>(table_.theta_count());
    const std::uint32_t slot = friction_.axis * (kFrictionTicks - 2) + phase - (phase > kFrictionTicks / 2 ? 2 : 1);
    const std::uint32_t place = (slot + slots - (kFrictionTicks / 2 - 1)) % slots;  // 0 after the look itself
    if (balance_.whole && place < kPlaces * narrow<std::uint32_t>(table_.segment_count))
      try_place(table_, motion_.arm, place, contact_);
  }
}

void CableArm::balance_next_axis(std::uint64_t tick) noexcept {
  const std::uint32_t axis = friction_.axis;
  follow_acceleration(table_, estimator_.theta_rad, estimator_.tension_N, kFrictionTicks * table_.tick_s, inertia_);
  ThetaVector off_rad{};
  for (Index k = 0; k < as_index(table_.theta_count()); ++k) off_rad[k] = estimator_.theta_rad[k] - model_.theta_rad[k];
  follow_slides(layout_, model_.geometry, off_rad, friction_.mu + friction_sd(friction_), balance_);
  // After a dither friction is nowhere, and what angles creep by says nothing of it.
  if (is_dithering(dither_) || contact_.state == ContactState::kDithered)
    fade_slip(layout_, kFrictionTicks * kDitherFade_1_s * kDitherMost * table_.tick_s, balance_.slip);
  const double load_Nm =
      static_load_Nm_[axis] + inertia_torque_Nm(table_, motion_.governor.mass_kg_m2, inertia_.accel_rad_s2, axis);
  const FrictionReadings planned{
      model_.geometry, ratio_,     slip_, wrap_rad_, inertia_.tension_N, table_.friction_mu, motion_.limiter.rate_rad_s,
      load_Nm,         is_moving()};
  watch_friction(table_, layout_, declared_mu_, planned, friction_);
  const double hours = static_cast<double>(tick) * table_.tick_s / 3600.0;
  const BalanceReadings felt{model_.geometry,
                             wrap_rad_,
                             inertia_.tension_N,
                             motion_.limiter.rate_rad_s,
                             friction_.mu,
                             friction_sd(friction_),
                             load_Nm,
                             table_.torque_zero.bias_N + table_.torque_zero.drift_N_h * hours,
                             contact_.state == ContactState::kDithered};
  balance_axis(table_, layout_, torque_limits_, felt, axis, balance_);
}

// What the balance of torques says, as faults: 5008 of the first drive of the segment, where that can be named, in
// 0.01 N m; 5009 in 0.0001.
void CableArm::watch_body(WatchScope scope, Watch& out) const noexcept {
  if (!scope.prepared) return;
  if (is_in_contact(contact_)) {
    std::int32_t first = contact_.segment < 0 ? -1 : 0;
    for (std::int32_t j = 0; j < contact_.segment; ++j) first += table_.segment[as_index(j)].cables;
    out.wrong(FaultNumber::kBodyContact, first, detail_of(100.0 * contact_.torque_Nm));
  }
  if (is_friction_too_high(declared_mu_, friction_))
    out.wrong(FaultNumber::kFrictionNotAsDeclared, -1, detail_of(1e4 * friction_.mu));
}

bool CableArm::is_moving() const noexcept {
  const double* const rate_rad_s = motion_.limiter.rate_rad_s.data();
  return dot_pairs(rate_rad_s, rate_rad_s, as_index(table_.segment_count)) > kMovingRate_rad_s * kMovingRate_rad_s;
}

// One sample lets the segment of a missed cable go, two when readings are in doubt already. An arm with weight lets
// nothing go: its drums stay, and watch_tension names the break.
void CableArm::watch_missed(std::uint64_t tick, FaultList& faults) noexcept {
  if (is_let_go(let_go_)) {
    judge_missed(tension_watch_.slack_ticks[as_index(let_go_.cable)] != 0, tick, let_go_, faults);
  } else if (missed_ >= 0 && may_let_go(table_) && !scatters(faults, missed_)) {
    const bool in_doubt = faults.count > 0 || cable_watch_.reversals > 0;
    if (!in_doubt || tension_watch_.slack_ticks[as_index(missed_)] > 1) let_go(layout_, missed_, let_go_);
  }
  missed_ = -1;
}

}  // namespace liana::cable
