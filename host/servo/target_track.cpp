#include "host/servo/target_track.hpp"

#include <algorithm>

namespace liana::servo {

namespace {

Vec3 turn_between(const Quat& from, const Quat& to) { return rotation_vector(multiply(to, conjugate(from))); }

}  // namespace

TargetTrack::TargetTrack(double tau_s, const std::array<double, kSwings>& swing_s) : tau_s_(tau_s) {
  if (swing_s[0] > 0.0) swing_.emplace(swing_s);
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

// The first images cannot tell which of two that disagree is wrong: they begin anew with the newer one.
ImageUse TargetTrack::take(double capture_s, const Pose& seen_in_base) {
  const Vec3 expected_m = swing_ && agreed_ > 0 ? swing_->expected_m(capture_s) : target_in_base_.position_m;
  const Vec3 off_m = subtract(seen_in_base.position_m, expected_m);
  const Vec3 off_rad = turn_between(target_in_base_.quaternion, seen_in_base.quaternion);
  const bool far_off = agreed_ > 0 && (norm(off_m) > kOutlier_m || norm(off_rad) > kOutlier_rad);
  if (far_off && agreed_ >= kAgreed) return ImageUse::kOutlier;
  if (agreed_ == 0 || far_off) {
    begin_with(capture_s, seen_in_base);
  } else {
    average(capture_s, seen_in_base, off_m, off_rad);
  }
  last_used_s_ = capture_s;
  return ImageUse::kUsed;
}

void TargetTrack::begin_with(double capture_s, const Pose& seen_in_base) {
  rejected_ += agreed_;
  used_ -= agreed_;
  agreed_ = 1;
  target_in_base_ = seen_in_base;
  if (swing_) swing_->begin(capture_s, seen_in_base.position_m);
}

void TargetTrack::average(double capture_s, const Pose& seen_in_base, const Vec3& off_m, const Vec3& off_rad) {
  ++agreed_;
  const double gain = std::clamp((capture_s - last_used_s_) / tau_s_, 1.0 / static_cast<double>(agreed_), 1.0);
  target_in_base_.quaternion = normalize(multiply(quaternion_of(scale(off_rad, gain)), target_in_base_.quaternion));
  if (!swing_) {
    target_in_base_.position_m = add(target_in_base_.position_m, scale(off_m, gain));
    return;
  }
  swing_->see(capture_s, seen_in_base.position_m);
  target_in_base_.position_m = swing_->mean_m();
}

}  // namespace liana::servo
