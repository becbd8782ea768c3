#include "hil/arm/tip_camera.hpp"

#include <nlohmann/json.hpp>

namespace liana::bench {

namespace {

constexpr double kTimeTolerance_s = 1e-9;  // slots are whole microseconds; sums of periods are not exact in binary

nlohmann::json pose_json(const std::optional<Pose>& pose) {
  if (!pose) return nullptr;
  const Vec3& p = pose->position_m;
  const Quat& q = pose->attitude;
  return {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
}

}  // namespace

TipCamera::TipCamera(const CameraConfig& config, const std::optional<Pose>& slit, const Pose& rod, std::uint64_t seed)
    : config_(config), slit_(slit), rod_(rod), noise_(seed, "tip camera") {}

std::optional<Pose> TipCamera::see(const Pose& tip, const Pose& target) {
  Pose seen = relative(tip, target);
  // Noise is drawn whether the target is in range or not, so that the stream depends on the seed and the picture number
  // only.
  const Vec3 shift{noise_.gaussian(config_.noise_m), noise_.gaussian(config_.noise_m),
                   noise_.gaussian(config_.noise_m)};
  const Vec3 turn{noise_.gaussian(config_.noise_rad), noise_.gaussian(config_.noise_rad),
                  noise_.gaussian(config_.noise_rad)};
  if (norm(seen.position_m) > config_.range_m) return std::nullopt;
  seen.position_m = seen.position_m + shift;
  seen.attitude = seen.attitude * from_rotation_vector(turn);
  return seen;
}

void TipCamera::look(double now_s, const Pose& tip) {
  if (now_s + kTimeTolerance_s < static_cast<double>(pictures_) / config_.rate_hz) return;
  ++pictures_;
  CameraView view;
  view.capture_time_s = now_s;
  if (slit_) view.slit = see(tip, *slit_);
  view.rod = see(tip, rod_);  // noise is drawn whether it is there or not
  if (!rod_seen_) view.rod.reset();
  if (!defects_.frozen) last_sound_ = view;
  spoil(view);
  if (!defects_.dropped) pending_.push_back(view);
}

// What is wrong with the camera, done to a picture; it never knows.
void TipCamera::spoil(CameraView& view) const {
  if (defects_.frozen) {
    view.slit = last_sound_.slit;
    view.rod = last_sound_.rod;
  }
  for (std::optional<Pose>* seen : {&view.slit, &view.rod}) {
    if (defects_.lost) seen->reset();
    if (!*seen) continue;
    Pose& pose = **seen;
    if (defects_.mirrored) {
      pose.position_m.y = -pose.position_m.y;
      pose.attitude = {pose.attitude.w, -pose.attitude.x, pose.attitude.y, -pose.attitude.z};
    }
    pose.position_m.y += defects_.jump_m;
  }
}

std::optional<CameraView> TipCamera::deliver(double now_s) {
  if (pending_.empty() ||
      now_s + kTimeTolerance_s < pending_.front().capture_time_s + config_.latency_s + defects_.late_s)
    return std::nullopt;
  const CameraView view = pending_.front();
  pending_.pop_front();
  return view;
}

std::string camera_message(const CameraView& view) {
  const nlohmann::json message{{"op", "camera"},
                               {"capture_time_s", view.capture_time_s},
                               {"slit", pose_json(view.slit)},
                               {"rod", pose_json(view.rod)}};
  return message.dump();
}

}  // namespace liana::bench
