// What every camera of the bench has: pictures at its rate, late, with what may be wrong with it.
#pragma once

#include <deque>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "hil/config/scene_config.hpp"
#include "hil/math/random.hpp"

namespace liana::bench {

// What may be wrong with the camera.
struct CameraDefects {
  bool dropped = false;   // no picture is taken
  bool frozen = false;    // every picture shows what the last sound one did
  bool lost = false;      // no picture shows anything
  bool mirrored = false;  // left and right are exchanged: y of what is seen
  double late_s = 0.0;    // so much later than the scene says
  double jump_m = 0.0;    // everything is seen so far beside where it is, along the tip's y
};

// View: a picture as delivered, with capture_time_s and seen(), pointers to the poses that it shows.
template <class View>
class Camera {
 public:
  // From the next picture on.
  void suffer(const CameraDefects& defects) { defects_ = defects; }
  // The next picture whose latency has passed, oldest first.
  std::optional<View> deliver(double now_s) {
    if (pending_.empty() ||
        now_s + kTimeTolerance_s < pending_.front().capture_time_s + config_.latency_s + defects_.late_s)
      return std::nullopt;
    const View view = pending_.front();
    pending_.pop_front();
    return view;
  }

 protected:
  explicit Camera(const CameraConfig& config) : config_(config) {}
  ~Camera() = default;

  const CameraConfig& config() const { return config_; }
  // Whether a picture is due; it has to be taken then.
  bool is_due(double now_s) {
    if (now_s + kTimeTolerance_s < static_cast<double>(pictures_) / config_.rate_hz) return false;
    ++pictures_;
    return true;
  }
  // Delivers the picture, with what is wrong with the camera, which never knows. `blind`: there is none.
  void take(View view, bool blind = false) {
    if (defects_.frozen) {
      for (std::size_t i = 0; i < view.seen().size(); ++i) *view.seen()[i] = *last_sound_.seen()[i];
    } else {
      last_sound_ = view;
    }
    for (std::optional<Pose>* seen : view.seen()) spoil(*seen);
    if (!defects_.dropped && !blind) pending_.push_back(view);
  }

 private:
  static constexpr double kTimeTolerance_s = 1e-9;  // slots are whole microseconds; sums of periods are not exact

  void spoil(std::optional<Pose>& seen) const {
    if (defects_.lost) seen.reset();
    if (!seen) return;
    if (defects_.mirrored) {
      seen->position_m.y = -seen->position_m.y;
      seen->attitude = {seen->attitude.w, -seen->attitude.x, seen->attitude.y, -seen->attitude.z};
    }
    seen->position_m.y += defects_.jump_m;
  }

  CameraConfig config_;
  std::int64_t pictures_ = 0;
  CameraDefects defects_;
  View last_sound_;
  std::deque<View> pending_;
};

// As camera messages have it; null where nothing is seen.
nlohmann::json pose_json(const std::optional<Pose>& pose);

}  // namespace liana::bench
