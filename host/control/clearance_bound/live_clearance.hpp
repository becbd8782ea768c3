// How far the arm certainly is from everything, now: once every command interval, from measured angles and the tip
// camera. What a caller does with it is its own affair; the level says what the scene file asks for.
#pragma once

#include <cstdint>
#include <optional>

#include "host/control/clearance_bound/camera_monitor.hpp"
#include "host/control/clearance_bound/scene_registration_check.hpp"
#include "host/control/clearance_bound/verified_clearance.hpp"

namespace liana::clearance_bound {

enum class Level : std::uint8_t { kFree, kSlow, kRefuse };
// "free", "slow", "refuse".
const char* level_name(Level level);

// How sure the claim is.
enum class Confidence : std::uint8_t {
  kMeasured,    // no picture was ever believed: measured angles, and the scene as drawn with the scene's own allowance
  kCamera,      // measured angles, and a picture believed within the last kCameraGone_s
  kCameraLost,  // the registration is that of the last picture that was believed; the bound grows
};
// "measured", "camera", "camera lost".
const char* confidence_name(Confidence confidence);

struct Claim {
  VerifiedClearance clearance;
  Confidence confidence = Confidence::kMeasured;
  std::optional<double> picture_age_s;  // of the last picture that was believed, since its capture
  CameraStatus trouble = CameraStatus::kNone;
  Level level = Level::kFree;
};

// What a prediction that begins now may go by.
struct Outlook {
  ThetaVector theta_off_rad{};  // angles as they are believed to be, less the measured ones
  Pose drawing_in_base{};       // where the frame stands that the scene is drawn in
  double prediction_m = 0.0;    // how much nearer to the scene the true arm may be than one predicted from there
};

class LiveClearance {
 public:
  // Without a slit there is nothing to register: bodies are where they are drawn.
  LiveClearance(const config::RobotConfig& robot, const config::SceneConfig& scene);

  // A picture that has arrived at `tick`, the newest one that look() was told.
  void see(const Picture& picture, std::uint64_t tick);
  // Once per command interval: the angles measured at `tick`.
  const Claim& look(std::uint64_t tick, const ThetaVector& measured_rad);

  const Claim& claim() const { return claim_; }  // of the last look
  // Of the last look. Until a picture is believed: angles as measured, the scene as drawn, and its own prediction_m
  // with what it may stand beside its drawing.
  Outlook outlook() const;
  const std::string& body_name() const;  // of the claim; empty when the scene is
  // Shift [m] and rotation vector [rad] of slit, plates and rod against the drawing; zero until a picture is believed.
  Vec3 shift_m() const { return believed_tick_ ? registration_.shift_m() : Vec3{}; }
  Vec3 turn_rad() const { return believed_tick_ ? registration_.turn_rad() : Vec3{}; }

 private:
  Level level_of(double distance_m) const;
  Pose drawing_in_base() const;

  RobotParams table_;
  config::SceneConfig scene_;
  Registration registration_;
  CameraMonitor watch_;
  SceneRegistrationCheck stand_;
  ClearanceFinder finder_;
  ArmHistory history_;
  ThetaVector measured_rad_{};
  std::uint64_t tick_ = 0;
  bool has_looked_ = false;
  std::optional<std::uint64_t> believed_tick_, arrived_tick_;
  CameraStatus trouble_ = CameraStatus::kNone;  // of the newest picture
  Claim claim_;
};

}  // namespace liana::clearance_bound
