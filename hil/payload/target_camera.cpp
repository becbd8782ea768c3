#include "hil/payload/target_camera.hpp"

#include <nlohmann/json.hpp>

namespace liana::bench {

namespace {

constexpr double kTimeTolerance_s = 1e-9;  // slots are whole microseconds; sums of periods are not exact in binary

Vec3 in_any_direction(Random& random, double length) {
  const Vec3 raw{random.gaussian(1.0), random.gaussian(1.0), random.gaussian(1.0)};
  return (length / norm(raw)) * raw;
}

}  // namespace

TargetCamera::TargetCamera(const CameraConfig& config, Lens lens, bool spread, std::uint64_t seed)
    : config_(config), lens_(lens), noise_(seed, "target camera") {
  if (!spread) return;
  Random bias(seed, "target camera bias");
  for (Pose& of_lens : bias_) {
    of_lens.position_m = in_any_direction(bias, config_.bias_m);
    of_lens.attitude = from_rotation_vector(in_any_direction(bias, config_.bias_rad));
  }
}

void TargetCamera::use(Lens lens, double now_s) {
  if (lens == lens_) return;
  lens_ = lens;
  blind_until_s_ = now_s + kSwitch_s;
}

// Noise is drawn whatever is seen, so that the stream depends on the seed and the picture number only.
std::optional<Pose> TargetCamera::see(const Pose& tip, const Pose& target) {
  const Vec3 shift = gaussian(noise_, config_.noise_m), turn = gaussian(noise_, config_.noise_rad);
  const bool dropped_out = noise_.uniform(0.0, 1.0) < config_.dropout;
  Pose seen = relative(tip, target);
  if (dropped_out || norm(seen.position_m) > config_.range_m) return std::nullopt;
  const Pose& bias = bias_[static_cast<std::size_t>(lens_)];
  seen.position_m = seen.position_m + bias.position_m + shift;
  seen.attitude = seen.attitude * bias.attitude * from_rotation_vector(turn);
  return seen;
}

void TargetCamera::look(double now_s, const Pose& tip, const Pose& target) {
  if (now_s + kTimeTolerance_s < static_cast<double>(pictures_) / config_.rate_hz) return;
  ++pictures_;
  TargetView view{now_s, lens_, see(tip, target)};
  if (!defects_.frozen) last_sound_ = view;
  spoil(view);
  if (!defects_.dropped && now_s >= blind_until_s_) pending_.push_back(view);
}

// What is wrong with the camera, done to a picture; it never knows.
void TargetCamera::spoil(TargetView& view) const {
  if (defects_.frozen) view.target = last_sound_.target;
  if (defects_.lost) view.target.reset();
  if (!view.target) return;
  Pose& pose = *view.target;
  if (defects_.mirrored) {
    pose.position_m.y = -pose.position_m.y;
    pose.attitude = {pose.attitude.w, -pose.attitude.x, pose.attitude.y, -pose.attitude.z};
  }
  pose.position_m.y += defects_.jump_m;
}

std::optional<TargetView> TargetCamera::deliver(double now_s) {
  if (pending_.empty() ||
      now_s + kTimeTolerance_s < pending_.front().capture_time_s + config_.latency_s + defects_.late_s)
    return std::nullopt;
  const TargetView view = pending_.front();
  pending_.pop_front();
  return view;
}

std::string target_message(const TargetView& view) {
  nlohmann::json target = nullptr;
  if (view.target) {
    const Vec3& p = view.target->position_m;
    const Quat& q = view.target->attitude;
    target = {p.x, p.y, p.z, q.w, q.x, q.y, q.z};
  }
  const nlohmann::json message{
      {"op", "camera"},   {"capture_time_s", view.capture_time_s},
      {"slit", nullptr},  {"rod", nullptr},
      {"target", target}, {"target_name", view.lens == Lens::kGrapple ? "grapple" : "adapter"}};
  return message.dump();
}

}  // namespace liana::bench
