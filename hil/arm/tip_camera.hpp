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

// What may be wrong with the camera.
struct CameraDefects {
  bool dropped = false;   // no picture is taken
  bool frozen = false;    // every picture shows what the last sound one did
  bool lost = false;      // no picture shows anything
  bool mirrored = false;  // left and right are exchanged: y of what is seen
  double late_s = 0.0;    // so much later than the scene says
  double jump_m = 0.0;    // everything is seen so far beside where it is, along the tip's y
};

class TipCamera {
 public:
  // Without a slit only the rod is seen.
  TipCamera(const CameraConfig& config, const std::optional<Pose>& slit, const Pose& rod, std::uint64_t seed);

  // The rod is out of its seat: seen no more.
  void lose_rod() { rod_seen_ = false; }
  // From the next picture on.
  void suffer(const CameraDefects& defects) { defects_ = defects; }
  // Takes a picture when one is due at `now_s` (seconds from the start, not falling).
  void look(double now_s, const Pose& tip);
  // The next picture whose latency has passed, oldest first.
  std::optional<CameraView> deliver(double now_s);

 private:
  std::optional<Pose> see(const Pose& tip, const Pose& target);
  void spoil(CameraView& view) const;

  CameraConfig config_;
  std::optional<Pose> slit_;
  Pose rod_;
  bool rod_seen_ = true;
  Random noise_;
  std::int64_t pictures_ = 0;
  CameraDefects defects_;
  CameraView last_sound_;
  std::deque<CameraView> pending_;
};

// The message of docs/reference/api.md.
std::string camera_message(const CameraView& view);

}  // namespace liana::bench
