// The second end's verdict: the simulated motion against the limits of robot and scene.
#pragma once

#include "host/arbiter/speed_zone.hpp"
#include "host/verify/judge_distances.hpp"

namespace liana::verify {

// What is told is held against the limits as they are. What the arm makes of it swings about that, and the limits leave
// room for the swing: these are the simulated arm's own.
constexpr double kSwingAngle_rad = 0.0087;  // 0.5 deg beyond the range of an angle
constexpr double kSwingRate = 1.25;         // times a joint's limit
constexpr double kSwingTip = 1.5;           // times the tip's limits
constexpr double kSwingTension_N = 5.0;     // what the simulation may be off by, of an arm that plans 40 N: taken off
constexpr double kNodeShare = 2.0;          // times the tip's limit: nodes may pass each other while the shape changes

// Limits of the simulation end.
struct MotionRules {
  cable::RobotTable table{};
  config::SceneConfig scene;
  arbiter::SpeedZone zone;
  config::Machine machine;    // that the controller runs on
  double arm_radius_m = 0.0;  // virtual walls are for the arm's surface
  Pose drawing_in_base{};     // where the scene stands
};

// Cables that come nearer to slack already than commands may bring them, as where two angles stand at their limits.
// Motions may lead them out, and else to no more than 1 N less than the most they have had since (of an arm that plans
// 40 N): one after the other they bring them no nearer. Never to less than floor_anywhere_N, simulated.
class TooSlack {
 public:
  // The next motion begins with so much left [N], a number for each cable.
  void stand(const cable::CableVector& left_N);
  // So much has to be left of cable c.
  double least_left_N(std::size_t c, double scale) const;

 private:
  static constexpr double kGivenAway_N = 1.0;
  cable::CableVector begins_N_{}, most_N_{};  // left as the motion begins, and at most since; 0: it is taut enough
};

// `comes_to_rest`: the sequence ends with the arm told to stand. `too_near` and `too_slack`: of all motions of
// this arm in turn. Cost: about 300 instructions a moment.
SimulationVerdict judge_simulated(const MotionRules& rules, const simulate::JointSequence& sequence, bool comes_to_rest,
                                  const simulate::Motion& motion, TooNear& too_near, TooSlack& too_slack);

}  // namespace liana::verify
