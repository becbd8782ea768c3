// The tip camera: sees slit and rod from the tip, late and with noise.
#pragma once

#include <array>
#include <string>

#include "hil/arm/camera.hpp"

namespace liana::bench {

// One picture, as delivered. Poses of the frames seen, in the tip frame at capture.
struct CameraView {
  double capture_time_s = 0.0;
  std::optional<Pose> slit;
  std::optional<Pose> rod;
  std::array<std::optional<Pose>*, 2> seen() { return {&slit, &rod}; }
};

class TipCamera : public Camera<CameraView> {
 public:
  // Without a slit only the rod is seen.
  TipCamera(const CameraConfig& config, const std::optional<Pose>& slit, const Pose& rod, std::uint64_t seed);

  // The rod is out of its seat: seen no more.
  void lose_rod() { rod_seen_ = false; }
  // Takes a picture when one is due at `now_s` (seconds from the start, not falling).
  void look(double now_s, const Pose& tip);

 private:
  std::optional<Pose> see(const Pose& tip, const Pose& target);

  std::optional<Pose> slit_;
  Pose rod_;
  bool rod_seen_ = true;
  Random noise_;
};

// The message of docs/reference/api.md.
std::string camera_message(const CameraView& view);

}  // namespace liana::bench
