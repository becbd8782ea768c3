// The second end's verdict: the simulated motion against the limits of robot and scene.
#pragma once

#include "host/control/arbiter/speed_zone.hpp"
#include "host/control/verification/judge_distances.hpp"

namespace liana::verification {

// What is told is held against the limits as they are. What the arm makes of it swings about that, and the limits leave
// room for the swing: these are the simulated arm's own.
constexpr double kSwingAngle_rad = 0.0087;  // 0.5 deg beyond the range of an angle
constexpr double kSwingRate = 1.25;         // times a joint's limit
constexpr double kSwingTip = 1.15;          // times the tip's limits
constexpr double kSwingTension_N = 5.0;     // what the simulation may be off by, of an arm that plans 40 N: taken off
constexpr double kNodeShare = 2.0;          // times the tip's limit: nodes may pass each other while the shape changes

// Limits of the simulation end.
struct MotionRules {
  cable::RobotParams table{};
  config::SceneConfig scene;
  arbiter::SpeedZone zone;
  config::Machine machine;    // that the controller runs on
  double arm_radius_m = 0.0;  // virtual walls are for the arm's surface
  Pose drawing_in_base{};     // where the scene stands
};

// `comes_to_rest`: the sequence ends with the arm told to stand. `too_near`: of all motions of this arm in turn.
// `stop`: what the arm does when nothing more is asked of it; how it swings then is no reason to refuse a motion that
// swings no worse. Cost: about 300 instructions a moment.
SimulationVerdict judge_simulated(const MotionRules& rules, const simulation::JointSequence& sequence,
                                  bool comes_to_rest, const simulation::Motion& motion, TooNear& too_near,
                                  const simulation::Motion* stop = nullptr);

}  // namespace liana::verification
