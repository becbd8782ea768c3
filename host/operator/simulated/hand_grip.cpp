#include "host/operator/simulated/hand_grip.hpp"

#include <algorithm>
#include <cmath>

namespace liana::simulated {
namespace {

constexpr double kMinReturn_s = 0.3;
constexpr double kPeakOfMinimumJerk = 1.875;  // peak speed over mean speed

double minimum_jerk(double s) { return s * s * s * (10.0 + s * (6.0 * s - 15.0)); }

// The vector opposite to `ahead`, half as long, at most `most`: there the coming motion is centred in the workspace.
Vec3 opposite(const Vec3& ahead, double most) {
  const double length = norm(ahead);
  return length > 0.0 ? scale(ahead, -std::min(0.5 * length, most) / length) : Vec3{};
}

}  // namespace

HandGrip::HandGrip(const HandGains& gains, const Quat& slit_in_base) : gains_(gains), slit_in_base_(slit_in_base) {}

PoseStep HandGrip::hand_step(const PoseStep& tip_step) const {
  return {scale(rotate(slit_in_base_, tip_step.shift_m), 1.0 / mapping_.scale),
          scale(rotate(slit_in_base_, tip_step.turn_rad), 1.0 / mapping_.rotation_scale)};
}

void HandGrip::start_return(const PoseStep& ahead) {
  const PoseStep step = hand_step(ahead);
  const Pose target{opposite(step.shift_m, 0.95 * gains_.reach_m),
                    quaternion_of(opposite(step.turn_rad, 0.95 * gains_.reach_rad))};
  return_from_ = pose_;
  return_step_ = step_between(pose_, target);
  return_s_ = 0.0;
  return_time_s_ = std::max(kMinReturn_s, kPeakOfMinimumJerk * norm(return_step_.shift_m) / gains_.return_speed_m_s);
}

bool HandGrip::advance_return(double dt_s) {
  return_s_ = std::min(return_time_s_, return_s_ + dt_s);
  const double share = minimum_jerk(return_s_ / return_time_s_);
  pose_ = moved(return_from_, {scale(return_step_.shift_m, share), scale(return_step_.turn_rad, share)});
  return return_s_ >= return_time_s_;
}

void HandGrip::grip(const Pose& commanded) {
  gripped_at_ = pose_;
  commanded_at_grip_ = commanded;
}

void HandGrip::follow(const Pose& commanded) {
  pose_ = moved(gripped_at_, hand_step(step_between(commanded_at_grip_, commanded)));
}

bool HandGrip::out_of_reach(const PoseStep& ahead, double stop_m) const {
  const Vec3 shift = hand_step(ahead).shift_m;
  const double length = norm(shift);
  const Vec3 onward = length > 0.0 ? scale(shift, std::min(1.0, stop_m / mapping_.scale / length)) : Vec3{};
  const Vec3 stop_at = add(pose_.position_m, onward);
  const bool outward = dot(stop_at, shift) > 0.0;
  const double turned = norm(rotation_vector(pose_.quaternion));
  const bool turning_on = dot(rotation_vector(pose_.quaternion), hand_step(ahead).turn_rad) > 0.0;
  return (outward && norm(stop_at) > gains_.reach_m) || (turning_on && turned > gains_.reach_rad);
}

}  // namespace liana::simulated
