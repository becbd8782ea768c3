// Clearance as an aim of the shape: the arm's middle is pushed away from given points while the tip stays.
#pragma once

#include "firmware_like/motion/shape_model.hpp"
#include "firmware_like/telecommand.hpp"

namespace liana {

// Largest weight of a target that is used; 0 when there is none.
double largest_weight(const KeepClearTargets& targets) noexcept;

// Sum over targets and segments of weight times what the segment's nearest point lacks of the distance [m].
double missing_clearance_m(const RobotTable& table, const ThetaVector& theta_rad, const ArmKinematics& arm,
                           const KeepClearTargets& targets) noexcept;

// Adds the push of every target on the nearest point of every segment. Cost: one pass over all links per target.
void add_clearance(const RobotTable& table, const ThetaVector& theta_rad, const ArmKinematics& arm, const KeepClearTargets& targets,
                   const NullSpace& space, ShapeModel& model) noexcept;

}  // namespace liana
