// The tip camera: sees slit and rod from the tip, late and with noise.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "hil/config/scene_config.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

// One picture, as delivered. Poses of the frames seen, in the tip frame at capture.
struct CameraView {
  double capture_time_s = 0.0;
  std::optional<Pose> slit;
  std::optional<Pose> rod;
};

class TipCamera {
 public:
  // Without a slit only the rod is seen.
  TipCamera(const CameraConfig& config, const std::optional<Pose>& slit, const Pose& rod, std::uint64_t seed);

  // Takes a picture when one is due at `now_s` (seconds from the start, not falling).
  void look(double now_s, const Pose& tip);
  // The next picture whose latency has passed, oldest first.
  std::optional<CameraView> deliver(double now_s);

 private:
  std::optional<Pose> see(const Pose& tip, const Pose& target);

  CameraConfig config_;
  std::optional<Pose> slit_;
  Pose rod_;
  Random noise_;
  std::int64_t pictures_ = 0;
  std::deque<CameraView> pending_;
};

// The message of docs/api.md.
std::string camera_message(const CameraView& view);

}  // namespace liana::bench
