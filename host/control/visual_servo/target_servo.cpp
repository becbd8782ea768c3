#include "host/control/visual_servo/target_servo.hpp"

#include <cmath>
#include <cstdio>

namespace liana::visual_servo {

namespace {

constexpr double kSwingShare =
    2.0;  // of the tolerance: what a base may still swing by, the noise of the estimate with it
constexpr double kKnownAfter = 1.5;  // periods of the slow swing
constexpr double kPassed_s = 1e-9;   // times are sums of intervals

const char* trouble_of(ImageUse use) {
  switch (use) {
    case ImageUse::kStale:
      return "images are older than one before";
    case ImageUse::kUnknown:
      return "images are of a time of which the tip's place is not remembered";
    case ImageUse::kFrozen:
      return "images do not change while the tip moves";
    case ImageUse::kOutlier:
      return "images show it more than 30 mm or 3 deg from where it was";
    case ImageUse::kUsed:
      break;
  }
  return "";
}

std::string seconds(const char* before, double time_s) {
  char text[80];
  std::snprintf(text, sizeof text, "%s %.3g s", before, time_s);
  return text;
}

}  // namespace

const char* servo_phase_name(ServoPhase phase) {
  switch (phase) {
    case ServoPhase::kApproaching:
      return "approaching";
    case ServoPhase::kDwelling:
      return "dwelling";
    case ServoPhase::kDone:
      return "done";
    case ServoPhase::kLost:
      return "lost";
    case ServoPhase::kTimedOut:
      return "timed_out";
    case ServoPhase::kStandby:
      break;
  }
  return "standby";
}

void TargetServo::note_tip(double now_s, const Pose& tip_measured) {
  history_.note(now_s, tip_measured);
  now_s_ = now_s;
  tip_measured_ = tip_measured;
}

void TargetServo::see(const std::string& target, double capture_s, const Pose& target_in_tip) {
  if (!is_under_way() || target != request_.target) return;
  std::optional<Pose> point = history_.at(capture_s);
  if (point) point = point_of(*point);
  const ImageUse use = track_.see(capture_s, compose(inverse(request_.point_in_tip), target_in_tip), point);
  if (use == ImageUse::kUsed) saw_ = true;
  trouble_ = trouble_of(use);
}

void TargetServo::begin(const ServoRequest& request, const Pose& tip_command) {
  request_ = request;
  request_.limits.sag_tau_s = request.swings.quick_s;  // an arm that gives way to a swing would feed it
  track_ = TargetTrack(request.tau_s, request.swings);
  approach_ = Approach(request.limits);
  approach_.begin(point_of(tip_command));
  way_.reset();
  report_ = {};
  report_.phase = ServoPhase::kApproaching;
  report_.target = request.target;
  report_.place = request.place;
  begun_s_ = last_seen_s_ = now_s_;
  saw_ = false;
  trouble_.clear();
}

std::optional<Pose> TargetServo::next(const Pose& tip_command) {
  if (!is_under_way()) return std::nullopt;
  look();
  if (!is_under_way()) return std::nullopt;
  const Pose from_point = inverse(request_.point_in_tip);
  if (!track_.is_settled()) return compose(approach_.brake(interval_s_), from_point);
  const Pose& target = track_.target_in_base();
  const Pose command = point_of(tip_command);
  Pose goal = compose(target, place_now(command));
  goal.position_m = add(goal.position_m, calming_m());
  return compose(approach_.next(target, goal, point_of(tip_measured_), command, interval_s_), from_point);
}

// Where the point should be beside the target now: on a base that swings the place comes to it slowly.
Pose TargetServo::place_now(const Pose& point_command) {
  if (request_.swings.slow_s <= 0.0) return request_.place;
  if (!way_) {
    const Pose from = compose(inverse(track_.target_in_base()), point_command);
    way_.emplace(from, request_.place, request_.limits, request_.swings);
    way_begun_s_ = now_s_;
  }
  return way_->at(now_s_ - way_begun_s_);
}

// Against the slow swing, once the filter has seen enough of it to know it well.
Vec3 TargetServo::calming_m() const {
  if (!way_ || now_s_ - way_begun_s_ < kKnownAfter * request_.swings.slow_s) return {};
  const double later_s = 1.0 / request_.limits.gain_1_s;  // so much later than its goal the tip moves
  return scale(track_.calming_m(now_s_ + later_s), request_.calming);
}

// The phase, and what is reported.
void TargetServo::look() {
  if (saw_) last_seen_s_ = now_s_;
  saw_ = false;
  report_.images_used = track_.used();
  report_.images_rejected = track_.rejected();
  report_.duration_s = now_s_ - begun_s_;
  if (track_.is_settled()) {
    const Pose& target = track_.target_in_base();
    report_.error = error_between(target, compose(target, request_.place), point_of(tip_measured_));
    report_.swing_m = track_.swing_m();
  }
  if (now_s_ - last_seen_s_ > request_.lost_s + kPassed_s) {
    const std::string why = trouble_.empty() ? "it is not seen" : trouble_;
    return end_as(ServoPhase::kLost, seconds("no usable image of it for", request_.lost_s) + ": " + why);
  }
  const bool was_within = report_.phase == ServoPhase::kDwelling;
  if (!is_within()) {
    report_.phase = ServoPhase::kApproaching;
  } else if (!was_within) {
    report_.phase = ServoPhase::kDwelling;
    within_since_s_ = now_s_;
  } else if (now_s_ - within_since_s_ >= request_.dwell_s - kPassed_s) {
    return end_as(ServoPhase::kDone, "");
  }
  if (report_.duration_s > request_.timeout_s + kPassed_s)
    end_as(ServoPhase::kTimedOut, seconds("not there after", request_.timeout_s));
}

bool TargetServo::is_within() const {
  if (!report_.error || report_.swing_m > kSwingShare * request_.tolerance_m) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::fabs(report_.error->m[i]) > request_.tolerance_m) return false;
    if (std::fabs(report_.error->rad[i]) > request_.tolerance_rad) return false;
  }
  return true;
}

void TargetServo::end_as(ServoPhase phase, const std::string& reason) {
  report_.phase = phase;
  report_.reason = reason;
}

void TargetServo::end(const std::string& reason) {
  if (is_under_way()) end_as(ServoPhase::kStandby, reason);
}

}  // namespace liana::visual_servo
