#include "hil/arm/tip_camera.hpp"

#include <nlohmann/json.hpp>

namespace liana::bench {

nlohmann::json pose_json(const std::optional<Pose>& pose) {
  if (!pose) return nullptr;
  const Vec3& p = pose->position_m;
  const Quat& q = pose->attitude;
  return {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
}

TipCamera::TipCamera(const CameraConfig& config, const std::optional<Pose>& slit, const Pose& rod, std::uint64_t seed)
    : Camera(config), slit_(slit), rod_(rod), noise_(seed, "tip camera") {}

std::optional<Pose> TipCamera::see(const Pose& tip, const Pose& target) {
  Pose seen = relative(tip, target);
  // Noise is drawn whether the target is in range or not, so that the stream depends on the seed and the picture number
  // only.
  const Vec3 shift = gaussian(noise_, config().noise_m), turn = gaussian(noise_, config().noise_rad);
  if (norm(seen.position_m) > config().range_m) return std::nullopt;
  seen.position_m = seen.position_m + shift;
  seen.attitude = seen.attitude * from_rotation_vector(turn);
  return seen;
}

void TipCamera::look(double now_s, const Pose& tip) {
  if (!is_due(now_s)) return;
  CameraView view;
  view.capture_time_s = now_s;
  if (slit_) view.slit = see(tip, *slit_);
  view.rod = see(tip, rod_);  // noise is drawn whether it is there or not
  if (!rod_seen_) view.rod.reset();
  take(view);
}

std::string camera_message(const CameraView& view) {
  const nlohmann::json message{{"op", "camera"},
                               {"capture_time_s", view.capture_time_s},
                               {"slit", pose_json(view.slit)},
                               {"rod", pose_json(view.rod)}};
  return message.dump();
}

}  // namespace liana::bench
