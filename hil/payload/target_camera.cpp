#include "hil/payload/target_camera.hpp"

#include <nlohmann/json.hpp>

namespace liana::bench {

namespace {

Vec3 in_any_direction(Random& random, double length) {
  const Vec3 raw{random.gaussian(1.0), random.gaussian(1.0), random.gaussian(1.0)};
  return (length / norm(raw)) * raw;
}

}  // namespace

TargetCamera::TargetCamera(const CameraConfig& config, Lens lens, bool spread, std::uint64_t seed)
    : Camera(config), lens_(lens), noise_(seed, "target camera") {
  if (!spread) return;
  Random bias(seed, "target camera bias");
  for (Pose& of_lens : bias_) {
    of_lens.position_m = in_any_direction(bias, config.bias_m);
    of_lens.attitude = from_rotation_vector(in_any_direction(bias, config.bias_rad));
  }
}

void TargetCamera::use(Lens lens, double now_s) {
  if (lens == lens_) return;
  lens_ = lens;
  blind_until_s_ = now_s + kSwitch_s;
}

// Noise is drawn whatever is seen, so that the stream depends on the seed and the picture number only.
std::optional<Pose> TargetCamera::see(const Pose& tip, const Pose& target) {
  const Vec3 shift = gaussian(noise_, config().noise_m), turn = gaussian(noise_, config().noise_rad);
  const bool dropped_out = noise_.uniform(0.0, 1.0) < config().dropout;
  Pose seen = relative(tip, target);
  if (dropped_out || norm(seen.position_m) > config().range_m) return std::nullopt;
  const Pose& bias = bias_[static_cast<std::size_t>(lens_)];
  seen.position_m = seen.position_m + bias.position_m + shift;
  seen.attitude = seen.attitude * bias.attitude * from_rotation_vector(turn);
  return seen;
}

void TargetCamera::look(double now_s, const Pose& tip, const Pose& target) {
  if (is_due(now_s)) take({now_s, lens_, see(tip, target)}, now_s < blind_until_s_);
}

std::string target_message(const TargetView& view) {
  const nlohmann::json message{{"op", "camera"},
                               {"capture_time_s", view.capture_time_s},
                               {"slit", nullptr},
                               {"rod", nullptr},
                               {"target", pose_json(view.target)},
                               {"target_name", view.lens == Lens::kGrapple ? "grapple" : "adapter"}};
  return message.dump();
}

}  // namespace liana::bench
