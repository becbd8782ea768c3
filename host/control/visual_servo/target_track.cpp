#include "host/control/visual_servo/target_track.hpp"

#include <algorithm>

#include "host/control/visual_servo/approach.hpp"

namespace liana::visual_servo {

namespace {}  // namespace

TargetTrack::TargetTrack(double tau_s, const motion::Swings& swings) : tau_s_(tau_s) {
  if (swings.slow_s <= 0.0) return;
  place_.emplace(swings);
  attitude_.emplace(swings, kAttitudeNoise_rad);
}

ImageUse TargetTrack::see(double capture_s, const Pose& target_in_tip, const std::optional<Pose>& tip_in_base) {
  const ImageUse use = judge(capture_s, target_in_tip, tip_in_base);
  ++(use == ImageUse::kUsed ? used_ : rejected_);
  return use;
}

ImageUse TargetTrack::judge(double capture_s, const Pose& target_in_tip, const std::optional<Pose>& tip_in_base) {
  if (capture_s <= last_capture_s_) return ImageUse::kStale;
  if (!tip_in_base) return ImageUse::kUnknown;
  last_capture_s_ = capture_s;
  if (is_frozen(target_in_tip, *tip_in_base)) return ImageUse::kFrozen;
  return take(capture_s, compose(*tip_in_base, target_in_tip));
}

bool TargetTrack::is_frozen(const Pose& target_in_tip, const Pose& tip_in_base) {
  const bool same = last_in_tip_ && last_in_tip_->position_m == target_in_tip.position_m &&
                    last_in_tip_->quaternion == target_in_tip.quaternion;
  if (same) return norm(subtract(tip_in_base.position_m, tip_at_last_.position_m)) > kFrozen_m;
  last_in_tip_ = target_in_tip;
  tip_at_last_ = tip_in_base;
  return false;
}

// Where the next image should show it.
Pose TargetTrack::expected_in_base(double capture_s) const {
  if (!place_ || agreed_ == 0) return target_in_base_;
  return {place_->expected(capture_s),
          normalize(multiply(quaternion_of(attitude_->expected(capture_s)), first_attitude_))};
}

// The first images cannot tell which of two that disagree is wrong: they begin anew with the newer one.
ImageUse TargetTrack::take(double capture_s, const Pose& seen_in_base) {
  const Pose expected = expected_in_base(capture_s);
  const Vec3 off_m = subtract(seen_in_base.position_m, expected.position_m);
  const Vec3 off_rad = turn_between(expected.quaternion, seen_in_base.quaternion);
  const bool far_off = agreed_ > 0 && (norm(off_m) > kOutlier_m || norm(off_rad) > kOutlier_rad);
  if (far_off && agreed_ >= kAgreed) return ImageUse::kOutlier;
  if (agreed_ == 0 || far_off) {
    begin_with(capture_s, seen_in_base);
  } else {
    ++agreed_;
    place_ ? filter(capture_s, seen_in_base) : average(capture_s, off_m, off_rad);
  }
  last_used_s_ = capture_s;
  return ImageUse::kUsed;
}

void TargetTrack::begin_with(double capture_s, const Pose& seen_in_base) {
  rejected_ += agreed_;
  used_ -= agreed_;
  agreed_ = 1;
  target_in_base_ = seen_in_base;
  if (!place_) return;
  first_attitude_ = seen_in_base.quaternion;
  place_->begin(capture_s, seen_in_base.position_m);
  attitude_->begin(capture_s, {});
}

void TargetTrack::average(double capture_s, const Vec3& off_m, const Vec3& off_rad) {
  const double gain = std::clamp((capture_s - last_used_s_) / tau_s_, 1.0 / static_cast<double>(agreed_), 1.0);
  target_in_base_.position_m = add(target_in_base_.position_m, scale(off_m, gain));
  target_in_base_.quaternion = normalize(multiply(quaternion_of(scale(off_rad, gain)), target_in_base_.quaternion));
}

void TargetTrack::filter(double capture_s, const Pose& seen_in_base) {
  place_->see(capture_s, seen_in_base.position_m);
  attitude_->see(capture_s, turn_between(first_attitude_, seen_in_base.quaternion));
  target_in_base_ = {place_->mean(), normalize(multiply(quaternion_of(attitude_->mean()), first_attitude_))};
}

}  // namespace liana::visual_servo
