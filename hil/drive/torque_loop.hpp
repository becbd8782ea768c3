// The loop that a torque-controlled drive closes around its joint torque sensor, at 1 kHz: what a bus is too slow for.
#pragma once

namespace liana::bench {

// Objects 3001:1 to :5 of such a drive, in SI units at the joint.
struct TorqueGains {
  double damping_Nms_rad = 3000.0;  // of the joint's rate against the rate that is wanted
  double drift_per_s = 2.0;         // slow integral of it: what keeps a force sensor's bias from being amplified
  double gain = 3.0;                // of the torque error
  double integral_per_s = 10.0;     // of it
  double derivative_s = 0.0;        // of the torque that is read
};

struct TorqueTarget {
  double feed_forward_Nm = 0.0;  // 6071 and 60B2
  double rate_rad_s = 0.0;       // 60B1, read as the rate that the damping is against (docs/reference/drives.md)
};

// The joint torque sensor, and the rate of the motor at the joint.
struct GearReading {
  double torque_Nm = 0.0;
  double rate_rad_s = 0.0;
};

class TorqueLoop {
 public:
  // Motor torque at the joint for the next step, within +-max_Nm; while it is at that limit, nothing winds up.
  double step(double step_s, const TorqueGains& gains, const TorqueTarget& target, const GearReading& gear,
              double max_Nm);
  // What the joint is asked for beside damping: a stop begins its ramp there.
  double held_Nm() const { return held_Nm_; }
  // Forgets all that it has summed up.
  void reset() { *this = {}; }

 private:
  double drift_rad_ = 0.0;
  double sum_Nms_ = 0.0;
  double last_Nm_ = 0.0;
  bool has_last_ = false;
  double held_Nm_ = 0.0;
};

// How such a drive comes to rest by itself: torque goes down along a ramp, damping stays, and only a joint that rests
// is locked. Locked at once, it would keep the force in the arm.
class TorqueStop {
 public:
  static constexpr double kRested_s = 0.5;   // in a row
  static constexpr double kLongest_s = 5.0;  // then it is locked as it is

  explicit TorqueStop(double held_Nm = 0.0, double ramp_s = 0.1) : held_Nm_(held_Nm), ramp_s_(ramp_s) {}

  // Feed-forward for the next step; `rests`: the joint is slow enough now.
  double step(double step_s, bool rests);
  bool done() const { return elapsed_s_ >= kLongest_s || (elapsed_s_ >= ramp_s_ && rested_s_ >= kRested_s); }

 private:
  double held_Nm_;
  double ramp_s_;
  double elapsed_s_ = 0.0;
  double rested_s_ = 0.0;
};

}  // namespace liana::bench
