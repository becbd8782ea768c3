#include "host/servo/target_track.hpp"

#include <algorithm>

namespace liana::servo {

namespace {

Vec3 turn_between(const Quat& from, const Quat& to) { return rotation_vector(multiply(to, conjugate(from))); }

}  // namespace

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
  const Vec3 off_m = subtract(seen_in_base.position_m, target_in_base_.position_m);
  const Vec3 off_rad = turn_between(target_in_base_.quaternion, seen_in_base.quaternion);
  const bool far_off = agreed_ > 0 && (norm(off_m) > kOutlier_m || norm(off_rad) > kOutlier_rad);
  if (far_off && is_settled()) return ImageUse::kOutlier;
  if (agreed_ == 0 || far_off) {
    rejected_ += far_off ? agreed_ : 0;
    used_ -= far_off ? agreed_ : 0;
    agreed_ = 1;
    target_in_base_ = seen_in_base;
  } else {
    ++agreed_;
    const double gain = std::clamp((capture_s - last_used_s_) / tau_s_, 1.0 / static_cast<double>(agreed_), 1.0);
    target_in_base_.position_m = add(target_in_base_.position_m, scale(off_m, gain));
    target_in_base_.quaternion = normalize(multiply(quaternion_of(scale(off_rad, gain)), target_in_base_.quaternion));
  }
  last_used_s_ = capture_s;
  return ImageUse::kUsed;
}

}  // namespace liana::servo
