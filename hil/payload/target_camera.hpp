// The camera of an arm that installs a payload: sees its target from the tip, late, with noise and bias; one lens for
// the payload's grapple, and from when the arm has the payload, another for the adapter.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "hil/arm/camera.hpp"

namespace liana::bench {

// Which lens, and so which target.
enum class Lens : std::uint8_t { kGrapple, kAdapter };

// One picture, as delivered: pose of the target's frame in the tip's frame at capture; nothing: it is not seen.
struct TargetView {
  double capture_time_s = 0.0;
  Lens lens = Lens::kGrapple;
  std::optional<Pose> target;
  std::array<std::optional<Pose>*, 1> seen() { return {&target}; }
};

class TargetCamera : public Camera<TargetView> {
 public:
  static constexpr double kSwitch_s = 1.0;  // without pictures while the lens changes; assumed

  // Without `spread` there is no bias; noise and dropouts there are always.
  TargetCamera(const CameraConfig& config, Lens lens, bool spread, std::uint64_t seed);

  // Changes the lens; nothing for the one that is on.
  void use(Lens lens, double now_s);
  Lens lens() const { return lens_; }
  // Takes a picture when one is due at `now_s` (seconds from the start, not falling); both poses in one frame.
  void look(double now_s, const Pose& tip, const Pose& target);

 private:
  std::optional<Pose> see(const Pose& tip, const Pose& target);

  Lens lens_;
  Pose bias_[2];  // of each lens
  Random noise_;
  double blind_until_s_ = 0.0;
};

// The message of docs/reference/api.md: the request `camera` with `target` and `target_name` ("grapple" or "adapter").
std::string target_message(const TargetView& view);

}  // namespace liana::bench
