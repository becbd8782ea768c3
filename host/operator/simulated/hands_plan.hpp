// How a person finds a way for an arm by sight: they imagine the drawn body to move along with their hands, and look
// how near it would come to the bodies of the drawing. No kinematics: the picture is pulled like a rope.
#pragma once

#include <vector>

#include "host/model/config/config.hpp"
#include "host/operator/simulated/arm_observation.hpp"
#include "host/operator/simulated/vr_gains.hpp"

namespace liana::simulated {

// Where both hands lead the arm, base frame.
struct HandsGoal {
  Pose tip{};
  Vec3 node_m{};
};

// The seen axis when its tip and its node have moved by so much: in between evenly, from the root on ever more.
std::vector<Vec3> imagined_axis(const ArmObservation& seen, const Vec3& tip_shift_m, const Vec3& node_shift_m);

// Least room that is imagined between the arm and the drawing's bodies while both hands go straight from where they are
// seen to be through `way`, in order; at most `within_m` of the tip's way, all of it where that is not said.
double imagined_room_m(const ArmObservation& seen, const config::SceneConfig& drawing,
                       const std::vector<HandsGoal>& way, double within_m = 1e9);

// A way to `tip_goal`: the node is led behind the tip against its heading (x), a little to one side where that leaves
// more room; both hands go round what is in the way. One or two places. About 1,500 imagined arms.
std::vector<HandsGoal> plan_hands(const VrGains& gains, const ArmObservation& seen, const config::SceneConfig& drawing,
                                  const Pose& tip_goal);

}  // namespace liana::simulated
