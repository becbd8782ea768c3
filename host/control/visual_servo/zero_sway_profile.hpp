// A point's way to its place beside a target, both in the target's frame, on a time law that leaves the base still.
#pragma once

#include "host/control/timing/trajectory_timing.hpp"
#include "host/control/visual_servo/approach.hpp"

namespace liana::visual_servo {

class ZeroSwayProfile {
 public:
  // Within the limits of speed and acceleration.
  ZeroSwayProfile(const Pose& from, const Pose& to, const ApproachLimits& limits, const motion::Swings& swings);

  double duration_s() const { return law_.duration_s(); }
  // Where the point should be so long after the begin.
  Pose at(double time_s) const;

 private:
  Pose from_, to_;
  Vec3 turn_rad_{};
  motion::TrajectoryTiming law_;
};

}  // namespace liana::visual_servo
