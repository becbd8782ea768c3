// The visual servo of the payload's mission (requirement B16): the tip, or a point of what it holds, goes to where it
// should be beside a target that a camera sees, stays there for the dwell, and the servo ends by itself. It gives tip
// goals, one in a command interval; who verifies and releases them is no business of this.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "firmware_like/math/pose.hpp"
#include "host/control/visual_servo/approach.hpp"
#include "host/control/visual_servo/target_track.hpp"
#include "host/control/visual_servo/tip_history.hpp"
#include "host/control/visual_servo/zero_sway_profile.hpp"

namespace liana::visual_servo {

// What is asked for.
struct ServoRequest {
  std::string target;  // which of what the camera sees
  Pose place{};  // where the point should be, in the target's frame: D, with the standing distance along the way in
  Pose point_in_tip{{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0}};  // what is led there: the tip, or of what it holds
  double tolerance_m = 0.0006;                               // xi: of each of the target's axes
  double tolerance_rad = 0.00698;
  double dwell_s = 1.0;  // so long within it
  double timeout_s = 120.0;
  double lost_s = 1.0;      // without a usable image
  double tau_s = 4.0;       // of the low-pass on images
  motion::Swings swings{};  // with which periods the arm's base swings
  double calming = 1.0;     // share of the slow swing by which the tip moves against it; 0: it is left as it is
  ApproachLimits limits{};
};

enum class ServoPhase : std::uint8_t { kStandby, kApproaching, kDwelling, kDone, kLost, kTimedOut };

// Its name in the state message: "standby", "approaching", "dwelling", "done", "lost", "timed_out".
const char* servo_phase_name(ServoPhase phase);

// How it goes, or how the last one went.
struct ServoStatus {
  ServoPhase phase = ServoPhase::kStandby;
  std::string target;
  std::optional<Pose> place;       // where the point should be, in the target's frame; nothing before the first
  std::optional<PoseError> error;  // left to go by the low-passed images; nothing before enough of them agree
  double swing_m = 0.0;            // how far the target swings in the arm's base
  std::int64_t images_used = 0;
  std::int64_t images_rejected = 0;
  double duration_s = 0.0;  // from its begin to now, or to its end
  std::string reason;       // why it ended without success
};

class TargetServo {
 public:
  // `interval_s`: between two goals.
  explicit TargetServo(double interval_s) : interval_s_(interval_s) {}

  // Once per interval, whether it is under way or not: the time, and where the tip was measured to be then.
  void note_tip(double now_s, const Pose& tip_measured);
  // An image of something, in the tip's frame at its exposure. What is not looked for is left out.
  void see(const std::string& target, double capture_s, const Pose& target_in_tip);

  // Begins with the tip commanded to be at `tip_command`.
  void begin(const ServoRequest& request, const Pose& tip_command);
  // The tip goal of the next interval; nothing once it is over.
  std::optional<Pose> next(const Pose& tip_command);
  // Ends it before its goal, for `reason`.
  void end(const std::string& reason);

  bool is_under_way() const {
    return report_.phase == ServoPhase::kApproaching || report_.phase == ServoPhase::kDwelling;
  }
  const ServoStatus& report() const { return report_; }

 private:
  void look();
  bool is_within() const;
  Pose place_now(const Pose& point_command);
  Vec3 calming_m() const;
  Pose point_of(const Pose& tip) const { return compose(tip, request_.point_in_tip); }
  void end_as(ServoPhase phase, const std::string& reason);

  double interval_s_;
  TipHistory history_;
  double now_s_ = 0.0;   // of the newest note
  Pose tip_measured_{};  // the newest note
  ServoRequest request_;
  TargetTrack track_;
  Approach approach_;
  std::optional<ZeroSwayProfile> way_;  // where the base swings, once its middle is known
  double way_begun_s_ = 0.0;
  ServoStatus report_;
  bool saw_ = false;  // since the last look
  double begun_s_ = 0.0;
  double last_seen_s_ = 0.0;  // when the last usable image came
  double within_since_s_ = 0.0;
  std::string trouble_;  // what is wrong with the newest image
};

}  // namespace liana::visual_servo
