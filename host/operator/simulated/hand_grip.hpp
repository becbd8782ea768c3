// The hand on the controller: small workspace, a button that engages, re-indexing by letting go, moving back and
// gripping again.
#pragma once

#include "host/operator/simulated/hand_gains.hpp"
#include "host/operator/simulated/slit_view.hpp"

namespace liana::simulated {

// How hand motion maps to the tip: P_r = a P_m from the clutch pose (docs/reference/api.md).
struct HandMapping {
  double scale = 1.0;           // tip metres per hand metre, > 0
  double rotation_scale = 1.0;  // tip turn per hand turn, > 0
  double speed_m_s = 0.0;       // most the tip is allowed while steering; 0: not said
};

// Hand pose in the device frame, which is parallel to the base frame; the tip's wishes are in the slit frame.
class HandGrip {
 public:
  HandGrip(const HandGains& gains, const Quat& slit_in_base);

  // Mapping of the next grip.
  void set_mapping(const HandMapping& mapping) { mapping_ = mapping; }
  // Starts moving back, button released, to where the coming motion `ahead` (tip, slit frame) has the most room.
  void start_return(const PoseStep& ahead);
  // One step of the return; true when there.
  bool advance_return(double dt_s);
  // Grips here: from now on the hand moves with the tip pose commanded, relative to `commanded`.
  void grip(const Pose& commanded);
  // Hand pose that sends the tip to `commanded`.
  void follow(const Pose& commanded);
  // True when the hand, braking over `stop_m` of tip path along `ahead`, would leave its reach.
  bool out_of_reach(const PoseStep& ahead, double stop_m) const;

  const Pose& pose() const { return pose_; }

 private:
  PoseStep hand_step(const PoseStep& tip_step) const;

  HandGains gains_;
  Quat slit_in_base_;
  HandMapping mapping_{};
  Pose pose_{};
  Pose gripped_at_{};
  Pose commanded_at_grip_{};
  Pose return_from_{};
  PoseStep return_step_{};
  double return_s_ = 0.0;
  double return_time_s_ = 1.0;
};

}  // namespace liana::simulated
