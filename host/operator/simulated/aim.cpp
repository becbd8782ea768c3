#include "host/operator/simulated/aim.hpp"

#include <algorithm>
#include <cmath>

namespace liana::simulated {
namespace {

constexpr double kStep_s = 0.001;

// `v` without its component along `direction` (which may be zero).
Vec3 without(const Vec3& v, const Vec3& direction) {
  const double length = norm(direction);
  if (length < 1e-9) return v;
  const Vec3 unit = scale(direction, 1.0 / length);
  return subtract(v, scale(unit, dot(v, unit)));
}

Vec3 limited(const Vec3& v, double most) {
  const double length = norm(v);
  return length > most ? scale(v, most / length) : v;
}

// How old the newest usable picture is, in steps.
std::size_t picture_age(const HandGains& gains) {
  return static_cast<std::size_t>(std::lround((gains.reaction_s + gains.camera_latency_s) / kStep_s));
}

}  // namespace

Aim::Aim(const HandGains& gains) : gains_(gains), history_(picture_age(gains) + 1) { reset({}); }

void Aim::reset(const Pose& seen_tip) {
  commanded_ = lagged_ = seen_tip;
  learned_ = {};
  surprise_m_ = 0.0;
  std::fill(history_.begin(), history_.end(), seen_tip);
}

void Aim::advance(const Pose& intended, double dt_s) {
  commanded_ = moved(intended, {scale(learned_.shift_m, -1.0), scale(learned_.turn_rad, -1.0)});
  const PoseStep behind = step_between(lagged_, commanded_);
  const double share = dt_s / (gains_.expected_lag_s + dt_s);
  lagged_ = moved(lagged_, {scale(behind.shift_m, share), scale(behind.turn_rad, share)});
  head_ = (head_ + 1) % history_.size();
  history_[head_] = lagged_;
}

void Aim::see(const Pose& seen_tip, double since_last_s, const PoseStep& ignored) {
  const Pose& oldest = history_[(head_ + 1) % history_.size()];
  const PoseStep off = step_between(moved(oldest, learned_), seen_tip);
  surprise_m_ = norm(off.shift_m);
  const Vec3 shift = scale(without(off.shift_m, ignored.shift_m), gains_.correction_per_s);
  const Vec3 turn = scale(without(off.turn_rad, ignored.turn_rad), gains_.correction_per_s);
  learned_.shift_m = add(learned_.shift_m, scale(limited(shift, gains_.correction_speed_m_s), since_last_s));
  learned_.turn_rad = add(learned_.turn_rad, scale(limited(turn, gains_.correction_rate_rad_s), since_last_s));
}

}  // namespace liana::simulated
