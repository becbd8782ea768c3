// A way that the arm is about to go, point by point, put to the independent check (plan_check.hpp).
#pragma once

#include <string>
#include <vector>

#include "host/model/config/config.hpp"

namespace liana::planner {

// Why the arm must not go straight in theta from each of these points [rad] to the next: the first piece of the way
// that comes nearer to an obstacle than `margin_m`, or to the arm itself than kSelfMargin_m and twice `off_m`, which is
// how far the arm may leave the way, or where the tension plan leaves its limits. Empty: it may. Point 0 is where the
// arm stands; on the way to point 1 twice `off_m` will do. Cost: about 5 ms a point past a slit.
std::string refusal_of_way(const config::RobotConfig& robot, const config::SceneConfig& scene,
                           const std::vector<cable::ThetaVector>& points_rad, double margin_m, double off_m);

// Why the arm must not go straight in theta to a goal [rad], and how far it could: the same limits, but it may come as
// near to an obstacle as verification lets a command (SceneMargins), and no nearer to anything, nor with
// more tension, than it stands where that is beyond the limit. Empty: it may. Cost: about 5 ms, past a slit 50 ms,
// where it is refused eight times that.
std::string refusal_of_move(const config::RobotConfig& robot, const config::SceneConfig& scene,
                            const cable::ThetaVector& from_rad, const cable::ThetaVector& goal_rad);

}  // namespace liana::planner
