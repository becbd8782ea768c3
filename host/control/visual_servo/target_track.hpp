// Where a target is in the arm's base, from images of it one after another: each image is carried to now by the
// measured motion of the tip since its exposure, which puts it into the base, where a target at rest stands still;
// there it is low-passed; where the base swings, mean and swing are told apart. Errors of the arm's geometry drop out
// of what is left to go, since target and tip are measured alike.
#pragma once

#include <cstdint>
#include <optional>

#include "firmware_like/math/pose.hpp"
#include "host/control/visual_servo/sway_filter.hpp"

namespace liana::visual_servo {

// An image this far from what earlier ones say is not believed: 15 deviations of the camera that is assumed (2 mm,
// 0.2 deg).
constexpr double kOutlier_m = 0.03;
constexpr double kOutlier_rad = 0.0524;
// So many images have to agree before anything moves.
constexpr std::int64_t kAgreed = 5;
// Where the base swings, so well has the middle to be known before anything moves.
constexpr double kKnownMean_m = 0.0015;
// The same picture again, while the tip has moved so far, is no new one.
constexpr double kFrozen_m = 0.001;

// What became of an image.
enum class ImageUse : std::uint8_t {
  kUsed,
  kStale,    // not newer than the one before
  kUnknown,  // where the tip was at its exposure is not remembered: too old, or of the future
  kFrozen,   // shows what an earlier one did, though the tip has moved
  kOutlier,  // too far from what earlier ones say
};

class TargetTrack {
 public:
  // `tau_s`: time constant of the low-pass. Its gain is the greater of 1/n, n images used, and 1/(f tau), with 1/f the
  // time since the image before.
  // `swings`: with which periods the base swings, roughly; the slow one 0: it does not. Where it does, swing
  // filters take the low-pass's place.
  explicit TargetTrack(double tau_s = 4.0, const motion::Swings& swings = {});

  // An image exposed at `capture_s` of `target_in_tip`; `tip_in_base`: measured at the exposure, nothing: not known.
  ImageUse see(double capture_s, const Pose& target_in_tip, const std::optional<Pose>& tip_in_base);

  // Enough images agree, and it is known where the middle of a swing is.
  bool is_settled() const { return agreed_ >= kAgreed && (!place_ || place_->mean_deviation() < kKnownMean_m); }
  // Low-passed, or the mean where the base swings; meaningful once an image was used.
  const Pose& target_in_base() const { return target_in_base_; }
  // Its swing about the mean, 0 where the base does not.
  double swing_m() const { return place_ ? place_->amplitude() : 0.0; }
  // How far from its place the tip has to be at `time_s`, so that the arm's mass calms the base's swing.
  Vec3 calming_m(double time_s) const { return place_ ? place_->calming(time_s) : Vec3{}; }
  std::int64_t used() const { return used_; }
  std::int64_t rejected() const { return rejected_; }

 private:
  ImageUse judge(double capture_s, const Pose& target_in_tip, const std::optional<Pose>& tip_in_base);
  bool is_frozen(const Pose& target_in_tip, const Pose& tip_in_base);
  ImageUse take(double capture_s, const Pose& seen_in_base);
  void begin_with(double capture_s, const Pose& seen_in_base);
  Pose expected_in_base(double capture_s) const;
  void average(double capture_s, const Vec3& off_m, const Vec3& off_rad);
  void filter(double capture_s, const Pose& seen_in_base);

  double tau_s_;
  std::optional<SwayFilter> place_, attitude_;  // where the base swings; attitudes as turns from the first one
  Quat first_attitude_{};
  Pose target_in_base_{};
  double last_capture_s_ = -1e18;  // of any image
  double last_used_s_ = 0.0;       // of one that was used
  std::int64_t agreed_ = 0;        // in the low-pass
  std::int64_t used_ = 0;
  std::int64_t rejected_ = 0;
  std::optional<Pose> last_in_tip_;  // of the last image that differed from the one before, and where the tip was then
  Pose tip_at_last_{};
};

}  // namespace liana::visual_servo
