// The camera of an arm that installs a payload: sees its target from the tip, late, with noise and bias; one lens for
// the payload's grapple, and from when the arm has the payload, another for the adapter.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "hil/arm/tip_camera.hpp"
#include "hil/config/scene_config.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

// Which lens, and so which target.
enum class Lens : std::uint8_t { kGrapple, kAdapter };

// One picture, as delivered: pose of the target's frame in the tip's frame at capture; nothing: it is not seen.
struct TargetView {
  double capture_time_s = 0.0;
  Lens lens = Lens::kGrapple;
  std::optional<Pose> target;
};

class TargetCamera {
 public:
  static constexpr double kSwitch_s = 1.0;  // without pictures while the lens changes; assumed

  // Without `spread` there is no bias; noise and dropouts there are always.
  TargetCamera(const CameraConfig& config, Lens lens, bool spread, std::uint64_t seed);

  // Changes the lens; nothing for the one that is on.
  void use(Lens lens, double now_s);
  Lens lens() const { return lens_; }
  // From the next picture on.
  void suffer(const CameraDefects& defects) { defects_ = defects; }
  // Takes a picture when one is due at `now_s` (seconds from the start, not falling); both poses in one frame.
  void look(double now_s, const Pose& tip, const Pose& target);
  // The next picture whose latency has passed, oldest first.
  std::optional<TargetView> deliver(double now_s);

 private:
  std::optional<Pose> see(const Pose& tip, const Pose& target);
  void spoil(TargetView& view) const;

  CameraConfig config_;
  Lens lens_;
  Pose bias_[2];  // of each lens
  Random noise_;
  std::int64_t pictures_ = 0;
  double blind_until_s_ = 0.0;
  CameraDefects defects_;
  TargetView last_sound_;
  std::deque<TargetView> pending_;
};

// The message of docs/reference/api.md: the request `camera` with `target` and `target_name` ("grapple" or "adapter").
std::string target_message(const TargetView& view);

}  // namespace liana::bench
