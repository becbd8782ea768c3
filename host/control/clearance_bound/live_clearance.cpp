#include "host/control/clearance_bound/live_clearance.hpp"

#include <algorithm>
#include <array>

#include "firmware_like/math/trig.hpp"

namespace liana::clearance_bound {
namespace {

constexpr double kLongAgo_s = 1e4;     // before the first look nothing is known of friction
constexpr double kCameraGone_s = 0.3;  // beyond the latency: several pictures in a row are missing or wrong

config::SceneCamera camera_of(const config::SceneConfig& scene) { return scene.camera.value_or(config::SceneCamera{}); }

// What of a motion and the stop after it no bound of now knows: friction that turns, and how the arm swings.
constexpr double kForesight_m = 0.002;
constexpr double kDoubtful_m = 0.002;  // a scene that seems to have gone further is not where the camera says

}  // namespace

const char* level_name(Level level) {
  static constexpr std::array<const char*, 3> kNames{"free", "slow", "refuse"};
  return kNames[static_cast<std::size_t>(level)];
}

const char* confidence_name(Confidence confidence) {
  static constexpr std::array<const char*, 3> kNames{"measured", "camera", "camera lost"};
  return kNames[static_cast<std::size_t>(confidence)];
}

LiveClearance::LiveClearance(const config::RobotConfig& robot, const config::SceneConfig& scene)
    : table_(robot.table),
      scene_(scene),
      registration_(robot.table, scene),
      watch_(camera_of(scene), robot.table.tick_s),
      stand_(robot.table.tick_s),
      finder_(robot.table, robot.module_radius_m, scene),
      history_(robot.table.tick_s) {}

const std::string& LiveClearance::body_name() const {
  static const std::string kNothing;
  const std::int32_t obstacle = claim_.clearance.obstacle;
  return obstacle < 0 ? kNothing : clearance::obstacle_name(scene_, obstacle);
}

// p_base = shift + pivot + turn (p_drawn - pivot).
Pose LiveClearance::drawing_in_base() const {
  const Pose pivot{registration_.pivot_m(), {1.0, 0.0, 0.0, 0.0}};
  return compose(registration_.registered(pivot), inverse(pivot));
}

Outlook LiveClearance::outlook() const {
  Outlook out;
  out.prediction_m = scene_.margins.prediction_m + finder_.near_links().allowance_m;
  if (!believed_tick_) return out;
  const double bound_m = finder_.near_links().uncertain_m + kForesight_m;
  out.drawing_in_base = drawing_in_base();
  const double moved_m = stand_.moved_m(out.drawing_in_base, claim_.clearance.where_m);
  if (moved_m > kDoubtful_m) {  // the arm as measured, the scene where it was
    out.drawing_in_base = stand_.before();
    out.prediction_m = std::max(out.prediction_m, bound_m) + moved_m;
    return out;
  }
  for (std::size_t i = 0; i < out.theta_off_rad.size(); ++i)
    out.theta_off_rad[i] = finder_.believed_rad()[i] - measured_rad_[i];
  out.prediction_m = bound_m + moved_m;
  return out;
}

void LiveClearance::see(const Picture& picture, std::uint64_t tick) {
  if (!scene_.slit || !scene_.camera) return;
  arrived_tick_ = tick;
  trouble_ = watch_.judge_time(picture, tick);
  if (trouble_ != CameraStatus::kNone) return;
  const std::optional<MeasuredArm> measured = history_.at(picture.tick);
  const bool shows_something = picture.slit_in_tip || picture.rod_in_tip;
  if (!measured || !shows_something) return;
  trouble_ = watch_.judge_view(picture, *measured, registration_);
  if (trouble_ != CameraStatus::kNone) return;
  registration_.take(picture, *measured);
  believed_tick_ = picture.tick;
  stand_.note(picture.tick, drawing_in_base());
}

Level LiveClearance::level_of(double distance_m) const {
  if (distance_m <= scene_.margins.refuse_m) return Level::kRefuse;
  return distance_m <= scene_.margins.slow_m ? Level::kSlow : Level::kFree;
}

const Claim& LiveClearance::look(std::uint64_t tick, const ThetaVector& measured_rad) {
  if (has_looked_ && tick <= tick_) return claim_;
  const auto since_s = [&](std::uint64_t before) { return static_cast<double>(tick - before) * table_.tick_s; };
  registration_.advance(has_looked_ ? since_s(tick_) : kLongAgo_s, measured_rad);
  history_.note(tick, measured_rad);
  measured_rad_ = measured_rad;
  tick_ = tick;
  has_looked_ = true;
  const double gone_s = camera_of(scene_).latency_s + kCameraGone_s;
  claim_ = {};
  claim_.confidence = believed_tick_ ? Confidence::kCamera : Confidence::kMeasured;
  if (believed_tick_) {
    claim_.picture_age_s = since_s(*believed_tick_);
    if (*claim_.picture_age_s > gone_s) claim_.confidence = Confidence::kCameraLost;
  }
  claim_.trouble = arrived_tick_ && since_s(*arrived_tick_) <= kCameraGone_s ? trouble_ : CameraStatus::kNoPicture;
  claim_.clearance = finder_.find(*history_.at(tick), {registration_, believed_tick_.has_value(),
                                                       scene_.margins.shift_m, scene_.margins.turn_deg * kDegree});
  claim_.level = level_of(claim_.clearance.distance_m);
  return claim_;
}

}  // namespace liana::clearance_bound
