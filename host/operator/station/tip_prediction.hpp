// What the commands that were sent make of the arm's tip, without the way there, without contact: the arm's own clutch
// and operator filter, run on the hand's side.
#pragma once

#include "firmware_like/cable/motion/motion.hpp"
#include "host/api/device/sample.hpp"
#include "host/control/arbiter/speed_zone.hpp"
#include "host/control/arbiter/teleop_input.hpp"
#include "host/control/virtual_fixtures/hand_motion.hpp"

namespace liana::station {

class TipPrediction {
 public:
  TipPrediction(const cable::RobotParams& table, const arbiter::SpeedZone& zone);

  // Another device or mapping; the tip stands.
  void begin(const arbiter::DeviceUse& use, const Pose& tip_in_base);
  // A sample is sent.
  void add(const device::Sample& sample);
  // A command interval is over: its samples become a goal, towards which the tip goes for the next one.
  void finish_interval();
  // The arm, which follows no hand, was told to be elsewhere.
  void stand_at(const Pose& tip_in_base);

  bool engaged() const { return steer_.engaged(); }
  const Pose& tip() const { return filter_.pose; }
  haptics::Motion motion() const { return {filter_.pose.position_m, filter_.linear.velocity}; }
  // Where the hand asks the tip to be.
  const Pose& goal() const { return goal_; }

 private:
  void advance(const Pose& from, const Pose& to, bool steered);

  cable::RobotParams table_;
  arbiter::SpeedZone zone_;
  arbiter::TeleopInput steer_;
  double asked_m_s_ = 0.0;
  TipFilterState filter_{};
  Pose goal_{};
};

}  // namespace liana::station
